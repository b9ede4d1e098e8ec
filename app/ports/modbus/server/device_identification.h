// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <tl/expected.hpp>
#include <vector>

#include "app/ports/modbus/server/request.h"

namespace orbwatch::app::modbus {

/// Read Device Identification (function 43 / 14, V1.1b3, 6.21), which libmodbus lacks: vendor,
/// product and version, the objects of the basic category. `pdu` begins with function code 43.
/// Returns the answer's protocol data unit. Reentrant.
tl::expected<std::vector<std::uint8_t>, Exception> identify(std::span<const std::uint8_t> pdu);

inline constexpr std::uint8_t kEncapsulatedInterface = 43;

}  // namespace orbwatch::app::modbus
