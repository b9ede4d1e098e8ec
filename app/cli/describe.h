#pragma once

#include <string>
#include <vector>

#include "proc/image/result.h"

namespace orbwatch::app {

/// What `orbwatch describe SUBJECT` prints. `arguments` begin with the subject. Reads files; writes
/// none but what -o names.
Result<std::string> describe_messages(const std::vector<std::string>& arguments);
Result<std::string> describe_registers(const std::vector<std::string>& arguments);
Result<std::string> describe_view(const std::vector<std::string>& arguments);
Result<std::string> describe_camera(const std::vector<std::string>& arguments);

}  // namespace orbwatch::app
