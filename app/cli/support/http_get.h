// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

#include "hal/socket_address.h"
#include "proc/image/result.h"

namespace orbwatch::app::cli::support {

struct HttpLimits {
  std::chrono::milliseconds time{5000};
  std::size_t bytes = std::size_t{8} << 20;
};

/// The body of the answer to GET `target` from a server on this computer. Errors: nothing listens,
/// the answer is not 200 (with its status), too large, cut off or too late. Reentrant; waits
/// `limits.time` at most.
Result<std::string> http_get(const hal::SocketAddress& server, const std::string& target,
                             const HttpLimits& limits = {});

}  // namespace orbwatch::app::cli::support
