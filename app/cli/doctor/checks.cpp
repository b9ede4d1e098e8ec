// SPDX-License-Identifier: Apache-2.0
#include "app/cli/doctor/checks.h"

#include <iterator>

namespace orbwatch::app::cli::doctor {
namespace {

struct Check {
  const char* name;
  Diagnoses (*run)(const Facts& facts);
};

constexpr std::array kChecks{Check{"configuration", check_configuration},
                             Check{"board", check_board},
                             Check{"kernel", check_kernel},
                             Check{"dma-heaps", check_heaps},
                             Check{"cameras", check_cameras},
                             Check{"lines", check_lines},
                             Check{"real time", check_real_time},
                             Check{"clock", check_clock},
                             Check{"receive buffer", check_receive_buffer},
                             Check{"ports", check_ports},
                             Check{"firewall", check_firewall},
                             Check{"disk", check_disk},
                             Check{"watchdog", check_watchdog},
                             Check{"heat and supply", check_heat}};

}  // namespace

Diagnoses diagnose(const Facts& facts) {
  Diagnoses all;
  for (const Check& check : kChecks) {
    for (Diagnosis& diagnosis : check.run(facts)) {
      diagnosis.check = check.name;
      all.push_back(std::move(diagnosis));
    }
  }
  return all;
}

}  // namespace orbwatch::app::cli::doctor
