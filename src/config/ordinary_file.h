// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

namespace cabinet_articulation::core {

/*
 * Files that come from outside. All throw std::runtime_error saying what is there and what was expected. None of them waits: a
 * pipe, a device, a socket or a folder is refused without being opened.
 */

/// The whole text. Throws, without the path, for what is missing, no ordinary file, cannot be read, or holds more than `largest`
/// bytes.
std::string readOrdinaryFile(const std::filesystem::path& path, std::size_t largest);

/// The same, or nothing if there is no such file.
std::optional<std::string> readFileIfThere(const std::filesystem::path& path, std::size_t largest);

/// For files that a library opens. Throws, with the path, for what is missing or no ordinary file.
void requireOrdinaryFile(const std::filesystem::path& path);

}  // namespace cabinet_articulation::core
