// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace cabinet_articulation::core {

/*
 * Names of fronts. They become names of joints, and parts of frames and parameters. So they are what ROS allows in one level of
 * a name: a letter, and then letters, digits and underscores.
 */

/// [characters] Ours: a label of that length fits an image of 640 pixels.
constexpr std::size_t kLongestName = 64;

/// What a front is called that nobody named: "front_3", whatever is learned of it.
std::string defaultName(std::uint32_t id);

/// Whose default name this is, if it is one.
std::optional<std::uint32_t> ownerOfDefaultName(const std::string& name);

/// In words, why this can be no name; empty if it can.
std::string whyUnfit(const std::string& name);

/// A name that fits and is free, as much like `wanted` as it can be. Underscores replace what does not fit. If that is taken, the
/// first number that is free follows.
std::string proposeName(const std::string& wanted, std::uint32_t id, const std::function<bool(const std::string&)>& is_free);

}  // namespace cabinet_articulation::core
