// SPDX-License-Identifier: BSD-3-Clause
// Loaded before all libraries that are not instrumented, in a build with ThreadSanitizer.
#include <boost/smart_ptr/detail/sp_counted_base.hpp>

namespace cv {
void setNumThreads(int threads);
}

namespace {

using Count = boost::detail::sp_counted_base;

// The order that boost::shared_ptr keeps between its owners in several threads would go unseen in ROS's libraries, and every
// message that changes hands pass for a race. They call these functions by name, and get the instrumented ones here.
[[gnu::used]] void (Count::*const kReleasing[])() = {&Count::release, &Count::weak_release};

// OpenCV's pool of threads keeps an order that is not seen either. Results do not depend on it.
[[gnu::constructor]] void keepOpenCvSingle() { cv::setNumThreads(1); }

}  // namespace
