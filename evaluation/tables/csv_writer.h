// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace cabinet_articulation::core::evaluation {

/// A table as a text file: one header line, commas, an empty cell for a number that is not there (NaN).
class CsvWriter {
 public:
  /// Throws std::runtime_error if the file cannot be written.
  CsvWriter(const std::string& path, const std::string& header) : path_(path), file_(path) {
    file_.precision(6);
    file_ << header << '\n';
    check();
  }

  template <class First, class... Rest>
  void row(const First& first, const Rest&... rest) {
    cell(first);
    ((file_ << ',', cell(rest)), ...);
    file_ << '\n';
    check();
  }

 private:
  void cell(double value) {
    if (!std::isnan(value)) file_ << value;
  }
  void cell(int value) { file_ << value; }
  void cell(bool value) { file_ << (value ? 1 : 0); }
  void cell(const std::string& value) { file_ << value; }
  void cell(const char* value) { file_ << value; }
  /// One cell for each value.
  void cell(const std::vector<double>& values) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (i > 0) file_ << ',';
      cell(values[i]);
    }
  }

  void check() {
    if (!file_) throw std::runtime_error("cannot write " + path_);
  }

  std::string path_;
  std::ofstream file_;
};

}  // namespace cabinet_articulation::core::evaluation
