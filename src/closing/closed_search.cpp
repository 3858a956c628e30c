// SPDX-License-Identifier: BSD-3-Clause
#include "closing/closed_search.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "cabinet_articulation/geometry/limits.h"
#include "cabinet_articulation/joints/joint.h"
#include "closing/closed_place.h"
#include "closing/rest_place.h"
#include "closing/surface_around.h"
#include "geometry/median.h"
#include "geometry/message_precision.h"

namespace cabinet_articulation::core {
namespace {

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

/// How far a front may be from where it is closed.
double reachOf(const LearnedModel& joint) { return joint.q_max - joint.q_min + stepsOf(joint).beyond; }

/// [nats] That a front which measures so far from the surface is closed rather than anywhere else within reach.
double closedLogOdds(const LearnedModel& joint, const Correction& measured) {
  const double flush = sigmaOfFlush(joint);
  const double variance = flush * flush + measured.sigma * measured.sigma;
  return std::log(reachOf(joint) / std::sqrt(2 * M_PI * variance)) - measured.q * measured.q / (2 * variance);
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
    CellsBeside seen;
    const Rectangle front = frontAt(joint, q);
    for (const DepthView* view : views) keepBest(lookBeside(*view, front, kNeighbourBand, kScanStep), edges, &seen);
    const double odds = surfaceLogOdds(seen);
    if (odds <= best_odds) continue;
    best_odds = odds;
    best = q;
  }
  return best;
}

constexpr double kFull = 0.7;  ///< of the cells that the front has (ours), beside an arm

/// How much of its place a front fills: all of it, unless it is a frame around a hole. Nothing while that is not known.
std::optional<double> fillOf(const LearnedModel& joint, const OwnEdges& edges) { return joint.hollow ? edges.fill() : 1; }

/// A view in which the front closes the surface.
struct ClosedView {
  const DepthView* view;
  Correction front;  ///< where the front itself is
};

constexpr double kLogOdds = 3;  ///< [nats] ln 20 (ours)

/// All views in which it is rather closed than anywhere else. To keep only those that agree best would make chance look certain.
std::vector<ClosedView> closedViews(const LearnedModel& joint, const OwnEdges& edges, const Surface& surface,
                                    const std::vector<const DepthView*>& views) {
  std::vector<ClosedView> closed;
  const std::optional<double> fill = fillOf(joint, edges);
  if (!fill) return closed;
  const Rectangle front_there = frontAt(joint, surface.q);
  for (const DepthView* view : views) {
    const FrontInView seen = look(*view, front_there, kNear);
    const bool is_full = seen.inside.in_plane >= kFull * *fill * seen.inside.seen();
    const std::optional<SurfacePlane> plane = is_full ? fitSurface(seen.front) : std::nullopt;
    if (!plane) continue;
    const Correction front = correctionTo(*plane, joint, surface.q);
    const double sigma = std::hypot(front.sigma, surface.sigma, surface.scatter);
    if (closedLogOdds(joint, {front.q, sigma}) > 0) closed.push_back({view, front});
  }
  return closed;
}

/// Relative to the surface.
std::optional<RestPlace> restOf(const LearnedModel& joint, const Surface& surface, const std::vector<ClosedView>& closed) {
  const double outwards = openEnd(joint, surface.q) == joint.q_max ? 1 : -1;
  std::vector<Correction> openings;
  for (const ClosedView& each : closed) openings.push_back({outwards * each.front.q, each.front.sigma});
  const Correction flush{0, std::hypot(sigmaOfFlush(joint), surface.sigma)};
  std::optional<RestPlace> rest = innermostRest(openings, flush, reachOf(joint));
  if (rest) rest->place.q *= outwards;
  return rest;
}

}  // namespace

void addSighting(const LearnedModel& joint, double q, const DepthView& view, FrontHistory* history) {
  const Rectangle front = frontAt(joint, q);
  history->edges.add(lookBeside(view, front, kNeighbourBand, 1), look(view, front, kNear).inside);
  history->sightings.push_back({view.stamp, front.pose});
}

std::optional<double> turnOf(const LearnedModel& joint, const std::vector<Sighting>& sightings,
                             const std::vector<DepthView>& views) {
  if (joint.type != JointType::kRotational) return 0;
  std::vector<double> turns;
  for (const DepthView& view : views) {
    const auto is_of_view = [&view](const Sighting& sighting) { return isSameStamp(sighting.stamp, view.stamp); };
    const auto sighting = std::find_if(sightings.begin(), sightings.end(), is_of_view);
    if (sighting == sightings.end()) continue;
    const double q = joint.configuration(sighting->front);
    const std::optional<SurfacePlane> plane = fitSurface(look(view, frontAt(joint, q), kNear).front);
    if (plane) turns.push_back(correctionTo(*plane, joint, q).q);
  }
  return turns.size() < kLeastViews ? std::nullopt : std::optional<double>(median(turns));
}

std::optional<ClosedPlace> findClosed(const LearnedModel& joint, const FrontHistory& history,
                                      const std::vector<DepthView>& views) {
  // A front goes no farther than it could be long: the search is over the whole way.
  if (!leavesItsPlane(joint) || joint.q_max - joint.q_min > limits::kSide.max) return std::nullopt;
  const OwnEdges& edges = history.edges;
  const std::vector<const DepthView*> scanned = spread(views);
  const std::optional<double> found = scan(joint, edges, scanned);
  if (!found) return std::nullopt;
  std::optional<Surface> surface = surfaceAround(joint, edges, *found, scanned);
  if (!surface) return std::nullopt;
  // An open front hides what is beside it. So the surface is looked at once more in those views in which the front may be closed,
  // and only those count that agree then.
  std::vector<const DepthView*> all, likely;
  for (const DepthView& view : views) all.push_back(&view);
  for (const ClosedView& each : closedViews(joint, edges, *surface, all)) likely.push_back(each.view);
  surface = surfaceAround(joint, edges, surface->q, likely);
  if (!surface || !(surface->sigma < sigmaOfFlush(joint))) return std::nullopt;
  surface->scatter = 0;
  const std::optional<RestPlace> rest = restOf(joint, *surface, closedViews(joint, edges, *surface, likely));
  if (!rest || rest->views < static_cast<int>(kLeastViews)) return std::nullopt;
  if (!(closedLogOdds(joint, {rest->place.q, std::hypot(rest->place.sigma, surface->sigma)}) > kLogOdds)) return std::nullopt;
  const double turn = turnOf(joint, history.sightings, views).value_or(0);
  const double q = surface->q + rest->place.q - turn;
  if (!isWithin(q, limits::kConfiguration) || !opensOutwardsFrom(joint, q)) return std::nullopt;
  return ClosedPlace{frontAt(joint, q), turn};
}

std::optional<bool> showsShut(const LearnedModel& joint, const std::optional<double>& turn, const OwnEdges& edges,
                              const DepthView& view) {
  const std::optional<double> fill = fillOf(joint, edges);
  if (!fill) return std::nullopt;
  const FrontInView seen = look(view, frontAt(joint, joint.q_closed), kNear);
  const CellCount& inside = seen.inside;
  const double half_empty = (1 - *fill / 2) * inside.all();
  if (inside.behind > half_empty) return false;
  // A front that was seen shut has depth, and a dark cabinet has none. What hides a front rarely ends at two of its edges.
  if (inside.behind + inside.blind > half_empty && isBetweenSurfaces(seen.beside)) return false;
  // The rim of an open cabinet may be all of it that has depth: cells without depth count.
  if (inside.in_plane < kFull * *fill * inside.all()) return std::nullopt;
  const std::optional<SurfacePlane> plane = fitSurface(seen.front);
  if (!plane) return std::nullopt;
  Correction front = correctionTo(*plane, joint, joint.q_closed);
  front.q -= turn.value_or(0);
  // An unknown turn is as uncertain as depth bends. It may explain why a shut front seems to be ajar.
  if (!turn) front.sigma = std::hypot(front.sigma, sigmaOfFlush(joint));
  const bool is_shut = closedLogOdds(joint, front) > kLogOdds;
  return is_shut || turn ? std::optional<bool>(is_shut) : std::nullopt;
}

}  // namespace cabinet_articulation::core
