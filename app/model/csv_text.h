// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

/// Fields of CSV (RFC 4180). All reentrant.
namespace orbwatch::app {

/// A text, in quotation marks where it needs them.
std::string csv_field(std::string_view text);

/// The shortest text that is this number again; empty for NaN, which is not valid.
std::string csv_number(double value);

}  // namespace orbwatch::app
