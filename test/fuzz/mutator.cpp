// SPDX-License-Identifier: BSD-3-Clause
#include "mutator.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "fuzz_target.h"

namespace cabinet_articulation::fuzz {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN(), kInfinity = std::numeric_limits<double>::infinity();

/// Numbers at which arithmetic breaks: no numbers, squares and sums that overflow, too small to divide by, beyond integers.
constexpr double kNumbers[] = {kNaN,   kInfinity,    -kInfinity, 1e308, -1e308, 1e154, 1e38,   -1e38, 3.4e38,
                               1e19,   -1e19,        1e10,       2.2e9, -2.2e9, 1e7,   1e4,    99.9,  -99.9,
                               10,     3.1415926535, 1,          -1,    1e-3,   0,     -1e-12, 1e-30, 1e-154,
                               1e-308, 5e-324,       0.5,        0.999, 1e-9,   -0.0,  100,    -100,  1e-5};
constexpr std::uint32_t kWords[] = {0,      1,          2,          3,          255,        256,  0x7f,
                                    0xffff, 0x7fffffff, 0x80000000, 0xffffffff, 0xfffffffe, 1000, 4000000000U};
constexpr const char* kTexts[] = {"nan",
                                  ".nan",
                                  "inf",
                                  ".inf",
                                  "-.inf",
                                  "1e308",
                                  "-1e308",
                                  "1e154",
                                  "1e38",
                                  "1e-320",
                                  "0",
                                  "-0",
                                  "-1",
                                  "1e9",
                                  "1e5",
                                  "0.001",
                                  "1",
                                  "2",
                                  "true",
                                  "4294967295",
                                  "4294967296",
                                  "2147483648",
                                  "[]",
                                  "{}",
                                  "~",
                                  "\"\"",
                                  "1e400",
                                  "- ",
                                  ": ",
                                  "\n",
                                  "99999999999999999999",
                                  "0x7f",
                                  "-2147483649"};

template <class Value>
Value at(const std::string& bytes, std::size_t offset) {
  Value value;
  std::memcpy(&value, &bytes[offset], sizeof value);
  return value;
}

template <class Value>
void put(const Value& value, std::size_t offset, std::string* bytes) {
  std::memcpy(&(*bytes)[offset], &value, sizeof value);
}

/// A number of a size that is usual in messages.
template <class Number>
bool looksLikeNumber(Number number) {
  return std::abs(number) >= Number(1e-7) && std::abs(number) <= Number(1e10);
}

/// The first place from `start` on where such a number is; `start` if there is none.
template <class Number>
std::size_t findNumber(const std::string& bytes, std::size_t start) {
  for (std::size_t i = start; i + sizeof(Number) <= bytes.size(); ++i)
    if (looksLikeNumber(at<Number>(bytes, i))) return i;
  return start;
}

bool isText(const std::string& bytes) {
  return std::all_of(bytes.begin(), bytes.end(), [](char c) { return (c >= ' ' && c <= '~') || c == '\n' || c == '\t'; });
}

bool isPartOfNumber(char c) { return (c >= '0' && c <= '9') || c == '.' || c == '-' || c == 'e' || c == '+'; }

}  // namespace

void Mutator::operator()(const std::vector<std::string>& seeds, std::string* input) {
  if (!seeds.empty() && (input->size() < 3 || below(64) == 0)) *input = seeds[below(seeds.size())];
  for (std::size_t changes = 1 + below(5) * below(2); changes > 0; --changes) changeOnce(input);
  if (input->size() > kLargestInput) input->resize(kLargestInput);
}

void Mutator::changeOnce(std::string* input) {
  if (input->size() < sizeof(double)) return input->push_back(static_cast<char>(below(256)));
  const std::size_t choice = below(16);
  if (choice == 0) return moveBlock(input);
  if (choice == 1) return input->resize(below(input->size()) + 1);
  if (isText(*input)) return choice < 14 ? rewriteText(input) : moveBlock(input);
  if (choice == 2)
    (*input)[below(input->size())] = static_cast<char>(below(256));
  else if (choice == 3)
    (*input)[below(input->size())] ^= static_cast<char>(1U << below(8));
  else if (choice < 6)
    overwriteWord(input);
  else
    overwriteNumber(input);
}

/// In place of a double or a float. Numbers that are 0 are found by chance only.
void Mutator::overwriteNumber(std::string* input) {
  const double number = below(4) == 0 ? kNumbers[below(std::size(kNumbers))] * (1 + 0.001 * static_cast<double>(below(1000)))
                                      : kNumbers[below(std::size(kNumbers))];
  const std::size_t start = below(input->size() - sizeof(double) + 1);
  const std::size_t where = below(4);
  if (where == 0) return put(static_cast<float>(std::clamp(number, -3.4e38, 3.4e38)), findNumber<float>(*input, start), input);
  const std::size_t offset = where == 1 ? start : findNumber<double>(*input, start);
  // A little beside what was there is what passes the checks.
  if (below(4) == 0) return put(at<double>(*input, offset) * (0.5 + 0.01 * static_cast<double>(below(100))), offset, input);
  put(number, offset, input);
}

/// In place of a length, an id, a stamp or a size.
void Mutator::overwriteWord(std::string* input) {
  const std::size_t offset = below(input->size() - sizeof(std::uint32_t) + 1);
  const std::uint32_t before = at<std::uint32_t>(*input, offset);
  put(below(2) == 0 ? kWords[below(std::size(kWords))] : before + static_cast<std::uint32_t>(below(5)) - 2, offset, input);
}

/// Another word in place of a number.
void Mutator::rewriteText(std::string* input) {
  const auto start = input->begin() + static_cast<std::ptrdiff_t>(below(input->size()));
  const auto first = std::find_if(start, input->end(), isPartOfNumber);
  const auto last = std::find_if_not(first, input->end(), isPartOfNumber);
  input->replace(first, last, kTexts[below(std::size(kTexts))]);
}

/// Takes some bytes away, or puts them elsewhere once more.
void Mutator::moveBlock(std::string* input) {
  const std::size_t first = below(input->size());
  const std::size_t length = 1 + below(std::min<std::size_t>(input->size() - first, below(4) == 0 ? input->size() : 64));
  const std::string block = input->substr(first, length);
  if (below(2) == 0)
    input->erase(first, length);
  else
    input->insert(below(input->size()), block);
}

}  // namespace cabinet_articulation::fuzz
