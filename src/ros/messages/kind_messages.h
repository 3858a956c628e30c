// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cabinet_articulation/Kind.h>

#include <vector>

#include "kinds/joint_kind.h"

namespace cabinet_articulation {

/// Those with the most joints first.
std::vector<Kind> toMessages(const std::vector<core::JointKind>& kinds);

}  // namespace cabinet_articulation
