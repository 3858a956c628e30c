// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gmock/gmock.h>

#include <exception>
#include <ostream>
#include <string>
#include <utility>

namespace cabinet_articulation::test {

/// A function that throws an Exception whose message matches.
template <class Exception>
class ThrowsSayingMatcher {
 public:
  explicit ThrowsSayingMatcher(testing::Matcher<std::string> message) : message_(std::move(message)) {}

  template <class Function>
  bool MatchAndExplain(const Function& function, testing::MatchResultListener* listener) const {
    try {
      function();
    } catch (const Exception& error) {
      *listener << "which says '" << error.what() << "'";
      return message_.Matches(error.what());
    } catch (const std::exception& error) {
      *listener << "which throws another type, saying '" << error.what() << "'";
      return false;
    }
    *listener << "which throws nothing";
    return false;
  }

  void DescribeTo(std::ostream* out) const {
    *out << "throws the expected type, and its message ";
    message_.DescribeTo(out);
  }
  void DescribeNegationTo(std::ostream* out) const { *out << "throws nothing, another type or another message"; }

 private:
  testing::Matcher<std::string> message_;
};

/// Matches a function by what it throws. As testing::ThrowsMessage, which GoogleTest 1.10 does not have yet.
template <class Exception>
testing::PolymorphicMatcher<ThrowsSayingMatcher<Exception>> ThrowsSaying(const testing::Matcher<std::string>& message) {
  return testing::MakePolymorphicMatcher(ThrowsSayingMatcher<Exception>(message));
}

}  // namespace cabinet_articulation::test
