// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/access/login/kept_logins.h"

#include <nlohmann/json.hpp>

#include "app/state/private_file.h"

namespace orbwatch::app::web {
namespace {

using Json = nlohmann::ordered_json;

std::int64_t to_number(Utc time) { return time.time_since_epoch().count(); }
Utc to_utc(const Json& number) { return Utc(std::chrono::seconds(number.get<std::int64_t>())); }

Json entries_json(const std::vector<LoginLimits::Entry>& entries) {
  Json list = Json::array();
  for (const auto& [key, failures, last] : entries) {
    list.push_back({{"key", key}, {"failures", failures}, {"last", to_number(last)}});
  }
  return list;
}

Json familiar_json(const std::vector<LoginLimits::Familiar>& familiar) {
  Json list = Json::array();
  for (const auto& [address, failed] : familiar) {
    list.push_back({{"name", failed.key},
                    {"address", address},
                    {"failures", failed.failures},
                    {"last", to_number(failed.last)}});
  }
  return list;
}

/// Reads familiar addresses, which files of earlier versions do not have.
std::vector<LoginLimits::Familiar> to_familiar(const Json& all) {
  std::vector<LoginLimits::Familiar> familiar;
  for (const Json& one : all.value("familiar", Json::array())) {
    familiar.push_back({one.at("address").get<std::string>(),
                        {one.at("name").get<std::string>(), one.at("failures").get<int>(),
                         to_utc(one.at("last"))}});
  }
  return familiar;
}

std::vector<LoginLimits::Entry> to_entries(const Json& list) {
  std::vector<LoginLimits::Entry> entries;
  for (const Json& one : list) {
    entries.push_back(
        {one.at("key").get<std::string>(), one.at("failures").get<int>(), to_utc(one.at("last"))});
  }
  return entries;
}

}  // namespace

Result<> load_logins(const std::filesystem::path& file, Sessions& sessions, LoginLimits& limits) {
  const auto text = read_private(file);
  if (!text) return tl::unexpected(text.error());
  if (!*text) return {};
  try {
    const Json all = Json::parse(**text);
    std::vector<Sessions::Session> kept;
    for (const Json& one : all.at("sessions")) {
      kept.push_back({one.at("hash").get<std::string>(), one.at("user").get<std::string>(),
                      one.at("password").get<std::string>(), to_utc(one.at("begun")),
                      to_utc(one.at("used"))});
    }
    limits.restore(to_entries(all.at("names")), to_entries(all.at("addresses")), to_familiar(all));
    sessions.restore(std::move(kept));
  } catch (const Json::exception&) {
    return fail(file.string() + ": is damaged; all users must log in again");
  }
  return {};
}

Result<> save_logins(const std::filesystem::path& file, const Sessions& sessions,
                     const LoginLimits& limits) {
  Json kept = Json::array();
  for (const auto& [hash, user, password, begun, used] : sessions.all()) {
    kept.push_back({{"hash", hash},
                    {"user", user},
                    {"password", password},
                    {"begun", to_number(begun)},
                    {"used", to_number(used)}});
  }
  const Json all{{"sessions", kept},
                 {"names", entries_json(limits.names())},
                 {"addresses", entries_json(limits.addresses())},
                 {"familiar", familiar_json(limits.familiar())}};
  // An attempted name may not be valid UTF-8.
  return write_private(file, all.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace orbwatch::app::web
