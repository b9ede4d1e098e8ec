// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/cli/doctor/diagnosis.h"

namespace orbwatch::app::cli::doctor {

/// The worst level.
Level worst(const Diagnoses& diagnoses);

/// One sentence with the numbers of faults and warnings.
std::string summary(const Diagnoses& diagnoses);

/// One line per diagnosis and the summary. Control characters become question marks.
std::string doctor_table(const Diagnoses& diagnoses);

/// One JSON document (RFC 8259): {"worst": LEVEL, "checks": [{"check", "level", "text",
/// "remedy"}]}. Bytes that are not UTF-8 become U+FFFD.
std::string doctor_json(const Diagnoses& diagnoses);

}  // namespace orbwatch::app::cli::doctor
