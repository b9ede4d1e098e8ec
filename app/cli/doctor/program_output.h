// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace orbwatch::app::cli::doctor {

struct ProgramLimits {
  std::chrono::milliseconds time{5000};
  std::size_t bytes = std::size_t{1} << 20;
};

/// Standard output of a program, in the language C. Nullopt: it cannot be started, ends with a
/// status other than 0, prints more than `limits.bytes`, or does not end in time; it and the rest
/// of its process group are killed then. Never waits longer.
std::optional<std::string> program_output(const std::filesystem::path& program,
                                          const std::vector<std::string>& arguments,
                                          const ProgramLimits& limits = {});

}  // namespace orbwatch::app::cli::doctor
