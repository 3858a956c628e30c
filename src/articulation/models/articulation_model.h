// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "articulation/fitting/work_schedule.h"
#include "articulation/models/joint_traits.h"
#include "articulation/observations/pose_sequence.h"
#include "cabinet_articulation/articulation/articulation_config.h"
#include "cabinet_articulation/articulation/learned_model.h"

namespace cabinet_articulation::core {

/// Where a joint is, for those that want an axis rather than a function.
struct JointGeometry {
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();       ///< unit; direction of growing q, or of the right-handed turn
  Eigen::Vector3d axis_point = Eigen::Vector3d::Zero();  ///< rotational: of the axis, nearest to the observed point
  double radius = 0;                                     ///< [m] from the axis to the observed point; 0: nothing turns
  double pitch = 0;                                      ///< [m/rad] advance along the axis while it turns
};

/// Standard deviations at which a pose counts as a false detection, which no model has to explain: farther away is no worse
/// (ours).
constexpr double kGrossSigmas = 5;

/// How far a track is from a model, pose by pose.
struct ModelResiduals {
  std::vector<double> q;
  std::vector<Eigen::Vector3d> position;     ///< [m] observed minus predicted, weighted as the track says
  std::vector<Eigen::Vector3d> orientation;  ///< [rad] rotation vector, weighted likewise
  /// How far the pose is off, in its own standard deviations but not in smaller ones than sigma_position and
  /// sigma_orientation.
  std::vector<double> displaced, turned;
  double q_min = 0, q_max = 0;  ///< over the poses near the model
  double path = 0;              ///< [m] length of the path between them
  double freedom = 0;           ///< [nats] what models that move pay for q in the likelihood, Eq. (6)
};

/// How far ArticulationModel::sequenceLogLikelihood() got.
struct SequenceProgress {
  double log_likelihood = 0;
  bool settled = true;  ///< more steps would find nothing better
};

/// One kind of joint (paper III-D.1). q is 0 at the first pose it was fitted to and grows in the direction of the first
/// opening: q_max >= -q_min.
class ArticulationModel {
 public:
  explicit ArticulationModel(const ArticulationConfig& config) : config_(config) {}
  virtual ~ArticulationModel() = default;

  virtual const JointTraits& traits() const = 0;
  JointType type() const { return traits().type; }
  bool moves() const { return traits().moves; }
  bool isParametric() const { return traits().is_parametric; }

  /// Number of parameters, for the penalty of Eq. (11).
  virtual int complexity(bool with_orientation) const = 0;

  /// [nats] How rare such a joint with these parameters is beside a drawer or a door, before any pose is seen.
  virtual double logPrior() const { return 0; }

  /// [nats] By how much its evidence may exceed that of a simpler joint: what it adds may be systematic error of the poses.
  virtual double largestAdvantage() const { return std::numeric_limits<double>::infinity(); }

  /// Estimates the parameters from a track of finite poses, in the order of their stamps. False if the track is too short for
  /// this model; the model is then unchanged. With a limited budget the track goes on from the one of the last call. The fit then
  /// starts from the last one, and may leave work to the next.
  virtual bool fit(const PoseSequence& track, const WorkBudget& budget = WorkBudget::unlimited()) = 0;

  /// The next fresh fit to the same track may start from `fitted`, a joint that may be a special case of this one.
  virtual void startFrom(const ArticulationModel& /*fitted*/) {}

  /// From now on the point of the front is observed that was `offset` away in the front's frame.
  virtual void moveReference(const Eigen::Vector3d& /*offset*/) {}

  /// The pose at q, Eq. (8).
  virtual Eigen::Isometry3d predict(double q) const = 0;

  /// The q whose pose is nearest: the inverse of predict().
  virtual double configuration(const Eigen::Isometry3d& pose) const = 0;

  /// The same for successive poses, which may tell more than each alone.
  virtual std::vector<double> configurations(const PoseSequence& track) const;

  virtual JointGeometry geometry() const = 0;

  /// Poses at equal steps from q_min to q_max, of joints that geometry() does not describe.
  virtual std::vector<Eigen::Isometry3d> curve(double /*q_min*/, double /*q_max*/) const { return {}; }

  /// Covariance of geometry() as ArticulationModel.msg defines it, for the point `p` of the front instead of the observed
  /// one. Residuals that follow one another, with a correlation of `correlation`, are accounted for.
  virtual Matrix6d covariance(const PoseSequence& track, const Eigen::Vector3d& p, double correlation) const = 0;

  virtual std::vector<ModelParam> parameters() const = 0;

  /// Log-likelihood of the track, up to a constant that all models share, when residuals follow one another. The model
  /// may adapt itself to that for the purpose, but its parameters stay. Compares models that move (see
  /// model_selection.h). `rival` is the best of the others so far: where the difference is clear, less effort will do. With a
  /// limited budget it goes on from the last call, and is the best so far.
  virtual SequenceProgress sequenceLogLikelihood(const PoseSequence& track, const WorkBudget& budget,
                                                 std::optional<double> rival) = 0;

  ModelResiduals residuals(const PoseSequence& track) const;

  /// [m] Way of a point of the front from q_min to q_max; `point` as seen from the observed one, in the front's frame.
  double pathLength(double q_min, double q_max, const Eigen::Vector3d& point) const;

  /// log p(D | M), Eqs. (6)-(10), for independent Gaussian noise. Positions and orientations have their own sigmas. q is uniform
  /// over the observed path, or as it was seen to be where that is more probable. The orientation's sigma counts `caution` times.
  double logLikelihood(const PoseSequence& track, const ModelResiduals& residuals, double caution = 1) const;

 protected:
  /// By which covariances exceed those of independent residuals, where `correlation` is that of each with the next.
  double covarianceInflation(double correlation) const;

  ArticulationConfig config_;

 private:
  double costOfFreedom(const PoseSequence& track, const ModelResiduals& residuals) const;
};

/// [m/rad] What the place of a learned joint's front says about q against its turn: 3 mm weigh as much as 0.1 rad (ours).
constexpr double kMetresPerRadian = 0.03;

/// Of the given type, a front of 0.4 by 0.6 m that is closed: for examples of joints.
LearnedModel closedExample(JointType type);

/// ArticulationModel.covariance of a pose whose coordinates have these variances [m^2, rad^2]. It is that of a point of the front
/// which is `lever` away from the observed one: the orientation's error moves it, too.
Matrix6d pointCovariance(double position_variance, double orientation_variance, const Eigen::Vector3d& lever);

/// Appends x, y, z.
void appendParam(const std::string& name, const Eigen::Vector3d& value, std::vector<ModelParam>* params);
/// Appends x, y, z, w.
void appendParam(const std::string& name, const Eigen::Quaterniond& value, std::vector<ModelParam>* params);

}  // namespace cabinet_articulation::core
