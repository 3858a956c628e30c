// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cabinet_articulation/articulation/learned_model.h"

namespace cabinet_articulation {

/// One front as people read it.
struct JointRow {
  std::uint32_t id = 0;
  std::string name;           ///< as given, or front_<id>
  std::string type;           ///< "rotational 97 %"
  std::string probabilities;  ///< of all types, one a line
  double opening = 0;         ///< 0..1, from closed to widest, or of the range seen where the closed position is not known
  std::string q;              ///< "34 deg"
  std::string range;          ///< "0 to 87 deg"
  std::string state;          ///< "open", "closed", "hangs on front_2" and the like, as a list in words
};

/// What moved, is expected to, or has a name, ordered by id. Fronts of which there is nothing to tell have no row.
std::vector<JointRow> jointRows(const std::vector<core::LearnedModel>& models);

/// "34 deg" or "12.5 cm".
std::string configurationText(const core::LearnedModel& model, double q);

/// "2 joints; 5 fronts did not move".
std::string summaryOf(const std::vector<core::LearnedModel>& models);

}  // namespace cabinet_articulation
