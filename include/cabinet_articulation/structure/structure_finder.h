// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "cabinet_articulation/articulation/articulation_config.h"
#include "cabinet_articulation/articulation/learned_model.h"
#include "cabinet_articulation/config/structure_config.h"
#include "cabinet_articulation/tracking/track.h"

namespace cabinet_articulation::core {

/// Two fronts whose configurations are functions of one another, as the leaves of a folding door.
struct CoupledFronts {
  std::uint32_t first = 0, second = 0;  ///< ids
  double ratio = 0;                     ///< by how much the second's q grows with that of the first
};

/**
 * What hangs on what (ours, after the structure search of the original release). The fronts are the nodes of a tree whose root is
 * the world. A front hangs on another if its poses relative to that one fit a joint, and fit it better than its poses in the
 * world fit any model. Both fits are made to the same observations, and compared by their residuals alone, for either way leaves
 * one degree of freedom. Residuals count for as many as are independent. The prior prefers the world.
 *
 * Only where the other front moved do the two differ. So pairs are looked at that are near, of which one is a joint and the other
 * moved, at once or in turn. Each update looks at one pair, of which a quarter more was seen since: observations, or way.
 *
 * A flush front cannot be told from what surrounds it while it is closed. Where it closes into the plane of another front and
 * lies within its outline, it is taken for a part of that. Then it moved along whenever that did.
 */
class StructureFinder {
 public:
  explicit StructureFinder(const ArticulationConfig& config, const StructureConfig& structure = {});
  ~StructureFinder();

  /// The models of these tracks, as they were learned in the world. Those that hang on another front become joints in its frame.
  /// While that is in view and no joint, they stay as they are.
  void complete(const std::vector<Track>& tracks, std::vector<LearnedModel>* models);

  /// Joints of an earlier run. Those that hang on others do so until observations contradict.
  void remember(const std::vector<LearnedModel>& joints);

  void forget(std::uint32_t id);
  void reset();

  /// Of the last update: pairs with one degree of freedom.
  const std::vector<CoupledFronts>& coupled() const;

 private:
  struct State;
  ArticulationConfig config_;
  StructureConfig structure_;
  std::unique_ptr<State> state_;
};

}  // namespace cabinet_articulation::core
