#include "app/daemon/site_check.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <tuple>

#include "app/daemon/view_memory.h"
#include "app/pipeline/measurement/compiled_recipe.h"
#include "app/ports/dds/security/participant_security.h"
#include "app/ports/web/tls/server_certificate.h"
#include "hal/host.h"
#include "hal/thread/scheduling.h"

namespace orbwatch::app {

Result<> check_keys(const Resolved& site, Dates dates) {
  const auto& dds = std::get<DdsSettings>(site.site.sinks);
  const auto& web = std::get<WebSettings>(site.site.sinks);
  const Result<> checked =
      dds.enabled && dds.security ? check_security(*dds.security, dds.domain, dates) : Result<>();
  if (!checked || !web.enabled || web.certificate.empty()) return checked;
  return web::named_certificate(web, now_for(dates)).map([](const auto&) {});
}

Result<> check_ports(const Resolved& site) {
  const auto& modbus = std::get<ModbusSettings>(site.site.sinks);
  const auto& web = std::get<WebSettings>(site.site.sinks);
  if (!modbus.enabled || !web.enabled || modbus.port == 0) return {};
  const auto meets = [&modbus](const std::string& address) {
    return address == modbus.address || hal::is_unspecified(address) ||
           hal::is_unspecified(modbus.address);
  };
  const bool is_http =
      web.port == modbus.port && std::ranges::any_of(http_addresses_of(web), meets);
  const bool is_https = https_port_of(web) == modbus.port && meets(web.address);
  if (!is_http && !is_https) return {};
  return fail(std::string("[web] ") + (is_http ? "port" : "https_port") +
              " and [modbus] port are both " + std::to_string(modbus.port) +
              "; give each a port of its own");
}

Result<SitePlan> checked_plan(const Resolved& site, Dates dates) {
  if (auto fits = check_view_memory(site); !fits) return tl::unexpected(fits.error());
  auto plan = SitePlan::make(site, expected_formats(site));
  if (!plan) return plan;
  for (std::size_t i = 0; i < plan->recipes.size(); ++i) {
    const auto checked = CompiledRecipe::check(plan->recipes[i], plan->scene);
    if (!checked) return tl::unexpected(in_recipe(site, i, checked.error()));
  }
  return hal::check(site.site.threads)
      .and_then([&] { return check_ports(site); })
      .and_then([&] { return check_keys(site, dates); })
      .map([&] { return std::move(*plan); });
}

Result<> check_site(const Resolved& site, Dates dates) {
  return checked_plan(site, dates).map([](const SitePlan&) {});
}

}  // namespace orbwatch::app
