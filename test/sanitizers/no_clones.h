// SPDX-License-Identifier: BSD-3-Clause
// Included before everything else in a build for fuzzing: clang instruments the choice between clones. It is made when a
// library is loaded and its calls lead nowhere yet.
#pragma once

#define target_clones(...)
