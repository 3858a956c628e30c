// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace cabinet_articulation {

/// Lets SIGTERM end this process as SIGINT does: roscpp shuts down and the nodelets are unloaded, with all they do at their
/// end. roscpp itself handles SIGINT only. A process with a SIGTERM handler of its own keeps it. Call it once ROS has started.
void endOnSigtermAsOnSigint();

}  // namespace cabinet_articulation
