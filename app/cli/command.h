#pragma once

#include <string>
#include <vector>

#include "proc/image/result.h"

namespace orbwatch::app {

/// A subcommand of `orbwatch`. `arguments` begin with its name.
using CommandFunction = Result<> (*)(const std::vector<std::string>& arguments);

Result<> project_command(const std::vector<std::string>& arguments);
Result<> describe_command(const std::vector<std::string>& arguments);
Result<> subscribe_command(const std::vector<std::string>& arguments);
Result<> state_command(const std::vector<std::string>& arguments);
Result<> command_command(const std::vector<std::string>& arguments);
Result<> dds_keys_command(const std::vector<std::string>& arguments);
Result<> list_command(const std::vector<std::string>& arguments);

}  // namespace orbwatch::app
