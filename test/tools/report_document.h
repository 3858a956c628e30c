// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <sstream>
#include <string>
#include <vector>

namespace cabinet_articulation {
namespace test {

/// Throws for what is not well-formed.
inline boost::property_tree::ptree parsed(const std::string& document) {
  std::istringstream in(document);
  boost::property_tree::ptree tree;
  read_xml(in, tree);
  return tree;
}

/// All elements of this name, wherever they are.
inline std::vector<boost::property_tree::ptree> elements(const boost::property_tree::ptree& tree, const std::string& name) {
  std::vector<boost::property_tree::ptree> found;
  for (const auto& [key, child] : tree) {
    if (key == name) found.push_back(child);
    const auto below = elements(child, name);
    found.insert(found.end(), below.begin(), below.end());
  }
  return found;
}

}  // namespace test
}  // namespace cabinet_articulation
