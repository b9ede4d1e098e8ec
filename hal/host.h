#pragma once

#include <string>
#include <string_view>

/// This computer in its networks. Thread-safe.
namespace orbwatch::hal {

/// Empty when the system does not know it.
std::string host_name();

/// Whether it is the unspecified address (RFC 4291, 2.5.2), 0.0.0.0 or ::, which stands for all
/// networks where one listens.
bool is_unspecified(std::string_view address);

}  // namespace orbwatch::hal
