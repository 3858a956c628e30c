// SPDX-License-Identifier: BSD-3-Clause
// Loaded before ROS's libraries in a build with ThreadSanitizer. They are not instrumented, so the order that boost::shared_ptr
// keeps between its owners in several threads would go unseen, and every message that changes hands pass for a race. They call
// these functions by name, and get the instrumented ones here.
#include <boost/smart_ptr/detail/sp_counted_base.hpp>

namespace {

using Count = boost::detail::sp_counted_base;

[[gnu::used]] void (Count::*const kReleasing[])() = {&Count::release, &Count::weak_release};

}  // namespace
