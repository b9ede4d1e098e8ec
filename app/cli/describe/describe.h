#pragma once

#include <string>
#include <vector>

#include "proc/image/result.h"

namespace orbwatch::app {

/// The output of `orbwatch describe SUBJECT`. `arguments` begin with the subject. Writes no file
/// but that of -o.
Result<std::string> describe_registers(const std::vector<std::string>& arguments);
Result<std::string> describe_view(const std::vector<std::string>& arguments);
Result<std::string> describe_camera(const std::vector<std::string>& arguments);

}  // namespace orbwatch::app
