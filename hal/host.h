// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

/// Names and addresses of this computer. Thread-safe.
namespace orbwatch::hal {

/// Host name; empty when the system does not know it.
std::string host_name();

/// True for the unspecified address (RFC 4291, 2.5.2), 0.0.0.0 or ::, which means all networks
/// when a server listens.
bool is_unspecified(std::string_view address);

}  // namespace orbwatch::hal
