// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "tests/support/abuse.h"

namespace orbwatch::app::tests {

/// Ways to abuse a Modbus server.
std::span<const orbwatch::tests::Abuse> abuses();

}  // namespace orbwatch::app::tests
