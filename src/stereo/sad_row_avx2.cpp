// SPDX-License-Identifier: BSD-3-Clause
// The same source as sad_row.cpp, compiled for AVX2 where the compiler can.
#include "stereo/sad_row.h"

#ifdef __AVX2__
#include "stereo/sad_row_kernel.h"
#endif

namespace cabinet_articulation::core {

SadRowFunction sadRowForAvx2() {
#ifdef __AVX2__
  return [](const SadRow& row) { matchRow(row); };
#else
  return nullptr;
#endif
}

}  // namespace cabinet_articulation::core
