// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/cli/doctor/diagnosis.h"
#include "app/cli/doctor/facts.h"

/// Checks: conclusions from facts. Each returns a line or more without the check's name, or none if
/// the configuration does not need it. All pure and reentrant.
namespace orbwatch::app::cli::doctor {

Diagnoses check_configuration(const Facts& facts);
Diagnoses check_board(const Facts& facts);
Diagnoses check_kernel(const Facts& facts);
Diagnoses check_heaps(const Facts& facts);
Diagnoses check_cameras(const Facts& facts);
Diagnoses check_lines(const Facts& facts);
Diagnoses check_real_time(const Facts& facts);
Diagnoses check_clock(const Facts& facts);
Diagnoses check_receive_buffer(const Facts& facts);
Diagnoses check_ports(const Facts& facts);
Diagnoses check_firewall(const Facts& facts);
Diagnoses check_disk(const Facts& facts);
Diagnoses check_watchdog(const Facts& facts);
Diagnoses check_heat(const Facts& facts);

/// Runs all of them, in this order, with their names.
Diagnoses diagnose(const Facts& facts);

}  // namespace orbwatch::app::cli::doctor
