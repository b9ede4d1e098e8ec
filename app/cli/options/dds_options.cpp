// SPDX-License-Identifier: Apache-2.0
#include "app/cli/options/dds_options.h"

namespace orbwatch::app::cli {

Option domain_option(int& domain) {
  return {"domain", 0, "N", "DDS domain, 0 to 230 (default 0)", [&domain](const std::string& v) {
            return parse_whole("domain", v).and_then([&domain](int n) -> Result<> {
              domain = n;
              if (n >= 0 && n <= 230) return {};
              return fail("--domain is " + std::to_string(n) + "; it must be 0 to 230");
            });
          }};
}

Option prefix_option(std::string& prefix) {
  return {"prefix", 0, "NAME", "of the topics, as in the configuration's [dds]\n(default orbwatch)",
          text_option(prefix)};
}

Option security_option(std::optional<dds::SecuritySettings>& security) {
  return {"security", 0, "FOLDER",
          "keys from `orbwatch dds-keys`, where orbwatchd has\n[dds.security]",
          [&security](const std::string& v) -> Result<> {
            security = dds::SecuritySettings{v};
            return {};
          }};
}

Option timeout_option(std::chrono::milliseconds& timeout) {
  return {"timeout", 0, "SECONDS",
          "give up after this time (default " + std::to_string(timeout.count() / 1000) + ")",
          [&timeout](const std::string& v) {
            return parse_number("timeout", v).and_then([&timeout](double seconds) -> Result<> {
              if (!(seconds > 0 && seconds <= 3600)) {
                return fail("--timeout must be above 0 and at most 3600");
              }
              timeout = std::chrono::ceil<std::chrono::milliseconds>(
                  std::chrono::duration<double>(seconds));
              return {};
            });
          }};
}

}  // namespace orbwatch::app::cli
