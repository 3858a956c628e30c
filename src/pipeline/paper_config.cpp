// SPDX-License-Identifier: BSD-3-Clause
// The paper's recipe in terms of our settings. Each value comes from the paper, or else from the launch files of its release
// (planar_objects, "release" below), or else from that release's code. The paper's learner is in the later articulation
// library ("library"). Settings that are not named here have the same value in ours, or are not used by this recipe.
#include "cabinet_articulation/pipeline/pipeline.h"

namespace cabinet_articulation::core {
namespace {

/// III-A: block matching over 128 disparities with an ambiguity test, which our defaults are; release: 15x15 windows.
StereoConfig paperStereo() {
  StereoConfig config;
  config.recover_left_band = false;  // block matching as it is has no depth there
  return config;
}

/// III-B.1. Not expressed: early acceptance at high support (nor did the release have it), and a RANSAC over all pixels. `stride`
/// remains 4 (release: 1, library: 15).
PlanesConfig paperPlanes() {
  PlanesConfig config;
  config.method = "paper";
  config.plane_distance = 0.02;  // Eq. (1): d
  config.hypotheses = 100;       // release, beside a confidence of 0.99
  config.max_planes = 1000;      // "until no more points remain" (release: 10)
  config.min_inliers = 6;        // release: it ends when 100 pixels are left, of which RANSAC sees every 16th
  config.refine = false;
  config.bend = false;
  return config;
}

/// III-B.2. Not expressed: we also start from the plane's outline and move the whole rectangle. We keep one rectangle per plane,
/// that with the largest g; the paper accepts each start on its own.
RectanglesConfig paperRectangles() {
  RectanglesConfig config;
  config.objective = "paper";  // Eq. (3), in the form of the library, which is never 0 for a good rectangle
  config.alpha = 0.05;
  config.cost_occluded = config.cost_unknown = 0.2;  // Fig. 5 (release: 0.2 and 0.5)
  config.random_starts = 10;                         // release
  config.first_step = 0.04;                          // library: 8, 4, 2 and 1 times 5 mm
  config.last_step = 0.005;
  config.refine_planes = config.refine_edges = false;
  config.min_precision = config.min_recall = 0.7;
  config.min_visible = config.min_observed_edges = config.min_observed_across = 0;
  config.min_side = 0.05;  // release
  config.max_side = 1.5;   // release
  config.use_tracks = false;
  return config;
}

/// III-C: "fixed thresholds on pose change", and the uncertainty of the size. Not expressed: the release takes the first track
/// that fits, not the nearest, and appends each duplicate of a frame. Our poses are placed by the edges that were seen.
TrackingConfig paperTracking() {
  TrackingConfig config;
  config.timeout = config.tentative_timeout = 20;  // release's code; its launch files never end a track
  config.confirmed_after = 1;
  config.min_presence = 0;
  config.position_tolerance = 0.2;                        // release
  config.angle_tolerance = config.twist_tolerance = 0.3;  // release
  config.size_tolerance = 0.05;                           // release
  config.max_speed = config.max_turn_rate = 0.01;         // the least there is: thresholds do not grow with time
  config.prediction_horizon = 0;                          // compared with the last observation
  config.max_ended_tracks = 0;
  return config;
}

/// III-D. Not expressed: one sigma for position and orientation in Eq. (9), and Eq. (10)'s independent observations when
/// prismatic and rotational are compared. Ours follow a sequence whose noise is correlated. Poses beyond `poses_max` are thinned
/// out. Short, narrow, restless or interrupted motions are doubted by our learner whatever the settings.
ArticulationConfig paperArticulation() {
  ArticulationConfig config;
  config.joint_types = "rigid prismatic rotational";
  config.sigma_position = config.sigma_position_floor = config.sigma_plane = 0.01;  // library
  config.sigma_orientation = config.sigma_orientation_floor = 0.1;                  // library, with a camera
  config.degrees_of_freedom = config.sequence_degrees_of_freedom = 1000;            // Eq. (9): Gaussian
  config.sigma_edge = config.prior.sigma_hinge = 0;                                 // nothing is known of fronts and hinges
  config.radius_min = 0.001;                                                        // library: any radius
  config.radius_max = config.marker_radius_max = 10;
  // Eq. (11) decides alone.
  config.sagitta_min = config.turn_min = config.edge_support_min = 0;
  config.motion_min = config.motion_to_noise = config.motion_to_jitter = 0;
  config.prior.rest_odds = 1e-6;
  config.outlier_share_max = 1;
  config.deviation_max = 100;
  config.covariance_factor = 1;
  return config;
}

/// Each front is learned by itself.
KindsConfig paperKinds() {
  KindsConfig config;
  config.kinds = false;
  return config;
}

StructureConfig paperStructure() {
  StructureConfig config;
  config.hanging = false;
  return config;
}

}  // namespace

PipelineConfig PipelineConfig::paper() {
  return {paperStereo(), paperPlanes(), paperRectangles(), paperTracking(), paperArticulation(), paperKinds(), paperStructure()};
}

}  // namespace cabinet_articulation::core
