// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "cabinet_articulation/articulation/articulation_config.h"
#include "cabinet_articulation/articulation/learned_model.h"
#include "cabinet_articulation/config/structure_config.h"
#include "cabinet_articulation/structure/structure_finder.h"
#include "cabinet_articulation/tracking/track.h"
#include "structure/seen_motion.h"

namespace cabinet_articulation::core {

/// A front that rather hangs on another one than on the world.
struct LikelyEdge {
  std::uint32_t child = 0, parent = 0;
  double log_odds = 0;  ///< [nats] with the prior
  double probability = 0;
};

/// A front that rather hangs on the world than on another one, as observations of this run say.
struct UnlikelyEdge {
  std::uint32_t child = 0, parent = 0;
  double evidence = 0;      ///< [nats] by likelihood alone; positive if it was too little against the prior
  bool was_likely = false;  ///< by fewer of these observations
};

/// Which pairs of fronts are looked at, and what was found out about each. One pair an update, so that the cost is bounded.
class FrontPairs {
 public:
  FrontPairs(const ArticulationConfig& config, const StructureConfig& structure) : config_(config), structure_(structure) {}

  /// Looks at the pair that is due for longest, if any is.
  void update(const std::vector<Track>& tracks, const std::vector<LearnedModel>& models);

  /// Of all pairs, the clearest first.
  std::vector<LikelyEdge> edges() const;

  /// The pair that the last update looked at, if that could tell, and told against it.
  const std::optional<UnlikelyEdge>& refuted() const { return refuted_; }

  const std::vector<CoupledFronts>& coupled() const { return coupled_; }

  /// See ratioOfCoupled(); nothing where it is not so.
  std::optional<double> ratio(std::uint32_t child, std::uint32_t parent) const;

  void forget(std::uint32_t id);

 private:
  using Ids = std::pair<std::uint32_t, std::uint32_t>;  ///< child, parent

  struct Pair {
    double observations = 0, way = 0;  ///< of both, when it was looked at
    std::uint64_t looked_at = 0;       ///< update; 0: never
    double log_odds = 0;
    bool likely = false;
    std::optional<double> ratio;
  };

  /// A track and its model.
  struct Front {
    const Track* track;
    const LearnedModel* model;
    const SeenMotion* motion;
  };

  /// Returns the evidence [nats]; nothing if nothing can be told, as of what rests in the frame of what it goes along with.
  std::optional<double> look(const Front& child, const Front& parent, Pair* pair);
  std::vector<Front> moved(const std::vector<Track>& tracks, const std::vector<LearnedModel>& models);
  bool isDue(const Pair& pair, const Front& a, const Front& b) const;
  void forgetOthers(const std::vector<LearnedModel>& models);
  void noteCoupled();

  ArticulationConfig config_;
  StructureConfig structure_;
  std::map<Ids, Pair> pairs_;
  std::uint64_t updates_ = 0;
  std::map<std::uint32_t, SeenMotion> motions_;
  std::optional<UnlikelyEdge> refuted_;
  std::vector<CoupledFronts> coupled_;
};

}  // namespace cabinet_articulation::core
