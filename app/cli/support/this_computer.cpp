// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include <chrono>

#include "app/cli/dds/received_state.h"
#include "app/cli/state_text.h"
#include "app/cli/support/http_get.h"
#include "app/cli/support/support_file.h"
#include "app/version.h"
#include "hal/host.h"
#include "hal/socket_address.h"

namespace orbwatch::app::cli::support {
namespace {

std::string environment_text() {
  std::string text;
  for (char** entry = ::environ; entry != nullptr && *entry != nullptr; ++entry) {
    text.append(*entry).push_back('\0');
  }
  return text;
}

/// The address by which this computer reaches its own server.
std::string own_address(const WebSettings& web) {
  const std::string address = http_addresses_of(web).back();
  if (!hal::is_unspecified(address)) return address;
  return address.find(':') == std::string::npos ? "127.0.0.1" : "::1";
}

Result<std::string> page(const WebSettings& web, const std::string& target) {
  if (web.port == 0) return fail("its port is not known: `port` of [web] is 0");
  const auto server = hal::parse_address(own_address(web), web.port);
  if (!server) return fail(own_address(web) + " is not an address of this computer");
  return http_get(*server, target);
}

Result<std::string> state(const DdsSettings& dds) {
  constexpr std::chrono::seconds kPatience{5};
  StateReader reader(dds.prefix);
  if (auto opened = reader.open(dds.domain, dds.security); !opened) {
    return tl::unexpected(opened.error());
  }
  std::string text;
  const auto arrived =
      reader.next(kPatience, [&](const ReceivedState& received) { text = state_json(received); });
  if (!arrived) return tl::unexpected(arrived.error());
  if (*arrived) return text;
  return fail(reader.refusal().empty() ? "nothing arrived in 5 s" : reader.refusal());
}

}  // namespace

SupportSources this_computer(const std::filesystem::path& config,
                             const std::filesystem::path& figures) {
  return {.board = doctor::this_computer(),
          .config = config,
          .versions = version_text("orbwatch"),
          .figures = figures,
          .environment = environment_text(),
          .page = page,
          .state = state};
}

}  // namespace orbwatch::app::cli::support
