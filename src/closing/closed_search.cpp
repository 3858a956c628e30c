// SPDX-License-Identifier: BSD-3-Clause
#include "closing/closed_search.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "cabinet_articulation/geometry/limits.h"
#include "cabinet_articulation/joints/joint.h"
#include "closing/closed_place.h"
#include "closing/front_in_view.h"
#include "geometry/median.h"

namespace cabinet_articulation::core {
namespace {

/// [m] Points that may belong to a plane before it is fitted: it may still be off by as much as neighbours may.
constexpr double kNear = 2 * kNeighbourBand;

constexpr int kScanStep = 2;         ///< cells; the search needs no more, and most of the time is spent there
constexpr std::size_t kScanned = 6;  ///< views in which the surface is searched for; it rests, so few do

struct Steps {
  double size, beyond;
};

/// How finely [m or rad] an opening is searched for, and how far beyond what was seen. A drawer is first seen as late as it is
/// half open; a door at any angle.
Steps stepsOf(const LearnedModel& joint) {
  return joint.type == JointType::kPrismatic ? Steps{0.01, 0.5} : Steps{0.04, M_PI / 2};
}

/// How far a closed front seems to be from its neighbours' plane. Kitchens are adjusted to 2 mm and a third of a degree. Depth
/// bends by as much from one place to the next (measured: up to a degree with a Kinect).
double sigmaOfFlush(const LearnedModel& joint) { return joint.type == JointType::kPrismatic ? 0.003 : 0.01; }

/// [nats] That a front which measures so far from the surface is closed rather than anywhere else within reach.
double closedLogOdds(const LearnedModel& joint, const Correction& measured) {
  const double flush = sigmaOfFlush(joint);
  const double variance = flush * flush + measured.sigma * measured.sigma;
  const double reach = joint.q_max - joint.q_min + stepsOf(joint).beyond;
  return std::log(reach / std::sqrt(2 * M_PI * variance)) - measured.q * measured.q / (2 * variance);
}

std::vector<const DepthView*> spread(const std::vector<DepthView>& views) {
  std::vector<const DepthView*> result;
  const std::size_t count = std::min(kScanned, views.size());
  for (std::size_t i = 0; i < count; ++i) result.push_back(&views[count > 1 ? i * (views.size() - 1) / (count - 1) : 0]);
  return result;
}

/// The opening at which the surface around the front goes on best.
std::optional<double> scan(const LearnedModel& joint, const OwnEdges& edges, const std::vector<const DepthView*>& views) {
  const Steps steps = stepsOf(joint);
  double best_odds = 0;
  std::optional<double> best;
  for (double q = joint.q_min - steps.beyond; q <= joint.q_max + steps.beyond; q += steps.size) {
    if (!opensOutwardsFrom(joint, q)) continue;
    std::array<CellCount, 4> seen;
    const Rectangle front = frontAt(joint, q);
    for (const DepthView* view : views) keepBest(lookBeside(*view, front, kNeighbourBand, kScanStep), edges, &seen);
    const double odds = surfaceLogOdds(seen);
    if (odds <= best_odds) continue;
    best_odds = odds;
    best = q;
  }
  return best;
}

/// Where the surface around the front is, and how far views scatter about that. It is the median of the views that tell it as
/// exactly as fronts are flush. Surface that is seen beside a hinge alone does not tell it so.
struct Surface {
  double q = 0;
  double scatter = 0;
};

/// The points beside those edges beyond which the plane goes on; what is farther back or nearer elsewhere is something else.
std::vector<Eigen::Vector3d> surfacePoints(const FrontInView& seen, const OwnEdges& edges) {
  std::vector<Eigen::Vector3d> points;
  for (std::size_t edge = 0; edge < seen.around.size(); ++edge)
    if (edges.isEdge(edge) && goesOn(seen.beside[edge]))
      points.insert(points.end(), seen.around[edge].begin(), seen.around[edge].end());
  return points;
}

std::optional<Surface> surfaceAround(const LearnedModel& joint, const OwnEdges& edges, double q,
                                     const std::vector<const DepthView*>& views) {
  constexpr int kIterations = 4;
  Surface surface{q, 0};
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    std::vector<double> corrections;
    const Rectangle front = frontAt(joint, surface.q);
    for (const DepthView* view : views) {
      const std::optional<SurfacePlane> plane = fitSurface(surfacePoints(look(*view, front, kNear), edges));
      if (!plane) continue;
      const Correction correction = correctionTo(*plane, joint, surface.q);
      if (correction.sigma < sigmaOfFlush(joint)) corrections.push_back(correction.q);
    }
    if (corrections.empty()) return std::nullopt;
    const double middle = median(corrections);
    for (double& correction : corrections) correction = std::abs(correction - middle);
    surface.q += middle;
    surface.scatter = kDeviationToSigma * median(corrections);
  }
  return surface;
}

constexpr double kFull = 0.7;  ///< of the cells (ours), beside an arm

bool isFull(const CellCount& inside) { return inside.in_plane > 0 && inside.in_plane >= kFull * inside.seen(); }

/// A view in which the front closes the surface.
struct ClosedView {
  const DepthView* view;
  Correction front;  ///< where the front itself is
};

constexpr double kLogOdds = 3;  ///< [nats] ln 20 (ours), in one view

std::vector<ClosedView> closedViews(const LearnedModel& joint, const Surface& surface,
                                    const std::vector<const DepthView*>& views) {
  std::vector<ClosedView> closed;
  const Rectangle front_there = frontAt(joint, surface.q);
  for (const DepthView* view : views) {
    const FrontInView seen = look(*view, front_there, kNear);
    const std::optional<SurfacePlane> plane = isFull(seen.inside) ? fitSurface(seen.front) : std::nullopt;
    if (!plane) continue;
    const Correction front = correctionTo(*plane, joint, surface.q);
    const double sigma = std::hypot(front.sigma, surface.scatter);
    if (closedLogOdds(joint, {front.q, sigma}) > kLogOdds) closed.push_back({view, front});
  }
  return closed;
}

double meanOf(const std::vector<ClosedView>& closed) {
  double sum = 0, weights = 0;
  for (const ClosedView& each : closed) {
    const double weight = 1 / (each.front.sigma * each.front.sigma);
    sum += weight * each.front.q;
    weights += weight;
  }
  return sum / weights;
}

}  // namespace

std::optional<Rectangle> findClosed(const LearnedModel& joint, const OwnEdges& edges, const std::vector<DepthView>& views) {
  constexpr std::size_t kLeastViews = 2;  // one may be wrong as a whole
  // A front goes no farther than it could be long: the search is over the whole way.
  if (!leavesItsPlane(joint) || joint.q_max - joint.q_min > limits::kSide.max) return std::nullopt;
  const std::vector<const DepthView*> scanned = spread(views);
  const std::optional<double> found = scan(joint, edges, scanned);
  if (!found) return std::nullopt;
  std::optional<Surface> surface = surfaceAround(joint, edges, *found, scanned);
  if (!surface) return std::nullopt;
  // An open front hides what is beside it. So the surface is looked at once more in those views in which the front may be closed,
  // and only those count that agree then.
  std::vector<const DepthView*> all, likely;
  for (const DepthView& view : views) all.push_back(&view);
  for (const ClosedView& each : closedViews(joint, *surface, all)) likely.push_back(each.view);
  surface = surfaceAround(joint, edges, surface->q, likely);
  if (!surface) return std::nullopt;
  surface->scatter = 0;
  const std::vector<ClosedView> closed = closedViews(joint, *surface, likely);
  if (closed.size() < kLeastViews) return std::nullopt;
  const double q = surface->q + meanOf(closed);
  if (!isWithin(q, limits::kConfiguration) || !opensOutwardsFrom(joint, q)) return std::nullopt;
  return frontAt(joint, q);
}

std::optional<bool> showsShut(const LearnedModel& joint, const DepthView& view) {
  const FrontInView seen = look(view, frontAt(joint, joint.q_closed), kNear);
  const CellCount& inside = seen.inside;
  if (2 * inside.behind > inside.seen() + inside.blind) return false;
  // The rim of an open cabinet may be all of it that has depth: cells without depth count.
  if (inside.in_plane < kFull * (inside.seen() + inside.blind)) return std::nullopt;
  const std::optional<SurfacePlane> plane = fitSurface(seen.front);
  if (!plane) return std::nullopt;
  return closedLogOdds(joint, correctionTo(*plane, joint, joint.q_closed)) > kLogOdds;
}

}  // namespace cabinet_articulation::core
