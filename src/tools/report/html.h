// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "tools/report/chart.h"

namespace cabinet_articulation {

/*
 * Pieces of HTML that are well-formed XML, too. Texts are given as they are to be read.
 */

/// The document; `body` is HTML.
std::string document(const std::string& title, const std::string& body);

/// <name>text</name>
std::string element(const std::string& name, const std::string& text);

/// Names and values in two columns; the values are HTML.
std::string factTable(const std::vector<std::pair<std::string, std::string>>& facts);

/// `cells` are HTML.
std::string tableRow(const std::string& cell_name, const std::vector<std::string>& cells);

/// A picture within the document.
std::string jpegElement(const std::vector<std::uint8_t>& jpeg, const std::string& description);

/// A chart as SVG of this size [px].
std::string chartElement(const Chart& chart, double width, double height);

}  // namespace cabinet_articulation
