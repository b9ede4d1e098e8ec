// SPDX-License-Identifier: Apache-2.0
#include "app/cli/doctor/program_output.h"

#include <utility>

#include "app/service/child_program.h"

namespace orbwatch::app::cli::doctor {

std::optional<std::string> program_output(const std::filesystem::path& program,
                                          const std::vector<std::string>& arguments,
                                          const ProgramLimits& limits) {
  auto end = run_child({.program = program,
                        .arguments = arguments,
                        .environment = {"LC_ALL=C", "PATH=/usr/sbin:/usr/bin:/sbin:/bin"},
                        .time = limits.time,
                        .bytes = limits.bytes});
  if (!end || end->status != 0) return std::nullopt;
  return std::move(end->output);
}

}  // namespace orbwatch::app::cli::doctor
