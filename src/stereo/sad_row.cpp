// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/sad_row.h"

#include "stereo/sad_row_kernel.h"

namespace cabinet_articulation::core {

void matchSadRow(const SadRow& row) { matchRow(row); }

}  // namespace cabinet_articulation::core
