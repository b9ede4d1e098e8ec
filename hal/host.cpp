// SPDX-License-Identifier: Apache-2.0
#include "hal/host.h"

#include <unistd.h>

#include <array>
#include <climits>

namespace orbwatch::hal {

std::string host_name() {
  std::array<char, HOST_NAME_MAX + 1> name{};
  if (::gethostname(name.data(), name.size() - 1) != 0) return {};
  return name.data();
}

bool is_unspecified(std::string_view address) { return address == "0.0.0.0" || address == "::"; }

}  // namespace orbwatch::hal
