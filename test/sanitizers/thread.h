// SPDX-License-Identifier: BSD-3-Clause
// Included before everything else in a build with ThreadSanitizer, for what its runtime of gcc up to 12 cannot do.
#pragma once

#include <cstddef>

// It does not see pthread_mutex_clocklock, by which std::timed_mutex waits. Without it, the library takes a call that is seen.
#undef _GLIBCXX_USE_PTHREAD_MUTEX_CLOCKLOCK

// gcc instruments the choice between clones, which is made before the runtime is there.
#define target_clones(...)
