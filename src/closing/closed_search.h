// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "cabinet_articulation/articulation/learned_model.h"
#include "cabinet_articulation/stereo/depth_view.h"
#include "closing/front_in_view.h"

namespace cabinet_articulation::core {

/*
 * Where a joint is closed, and whether it was seen so.
 *
 * A closed front lies in one surface with its neighbours, so a rectangle detector cannot see it. Its track begins when it is a
 * hand's breadth open, and ends there again. But the joint tells where it was before. Two questions to the views:
 * 1. At which opening does the surface around the front's place lie in the front's plane? This is where it would be closed.
 * 2. Was the front seen at rest there? Its place is full then, and the plane through it tells its opening. All views together
 *    must make it likely that a front which is so far from the surface closes it.
 * A front that was ajar all the time has an answer to the first question alone, and it was not seen closed.
 */

constexpr std::size_t kLeastViews = 2;  ///< ours: one may be wrong as a whole

/// A front where it was detected.
struct Sighting {
  double stamp = 0;  ///< [s] of the view, too
  Eigen::Isometry3d front = Eigen::Isometry3d::Identity();
};

/// What was seen of a front while it was open.
struct FrontHistory {
  OwnEdges edges;
  std::vector<Sighting> sightings;
};

/// Adds a view in which the joint's front was detected, at q.
void addSighting(const LearnedModel& joint, double q, const DepthView& view, FrontHistory* history);

/// Where a front is closed.
struct ClosedPlace {
  Rectangle front;             ///< in the fixed frame
  std::optional<double> turn;  ///< turnOf(); nothing while it is not known
};

/// [rad] By how much views see a door's front turned about its axis, against where its joint has it: the median where it was
/// detected. A joint has its q from where the front is, which bent depth hardly changes. The closed place is told by the
/// direction of the front's plane, which bent depth turns. Nothing for too few views. 0 for a drawer: its place tells both.
std::optional<double> turnOf(const LearnedModel& joint, const std::vector<Sighting>& sightings,
                             const std::vector<DepthView>& views);

/// Nothing unless the front was seen closed.
std::optional<ClosedPlace> findClosed(const LearnedModel& joint, const FrontHistory& history,
                                      const std::vector<DepthView>& views);

/// Whether a view shows the front of a joint with a known closed position there. `turn`: of its ClosedPlace. No answer: its place
/// is hidden or not in view; the front is hollow, and its fill not known; or it seems to be ajar, and its turn is not known.
std::optional<bool> showsShut(const LearnedModel& joint, const std::optional<double>& turn, const OwnEdges& edges,
                              const DepthView& view);

}  // namespace cabinet_articulation::core
