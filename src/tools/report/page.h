// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "tools/report/front_section.h"
#include "tools/results/run_summary.h"

namespace cabinet_articulation {

/// The report of a run as one document of HTML that needs no other file.
std::string reportPage(const RunFacts& facts, const RunRecord& record, const FramePictures& pictures, const RunSummary& summary);

}  // namespace cabinet_articulation
