// SPDX-License-Identifier: Apache-2.0
#include <chrono>

#include "app/cli/command.h"
#include "app/cli/keys/keystore.h"
#include "app/cli/options/dds_options.h"
#include "app/cli/options/options.h"
#include "app/ports/dds/topics/topic_names.h"

namespace orbwatch::app::cli {
namespace {

/// About a hundred years: the dates of DDS Security end in 2262.
constexpr int kMaxDays = 36500;

struct KeysOptions {
  KeystoreRequest request;
  int domain = 0;
  std::string prefix = "orbwatch";
  bool read_only = false;
};

std::vector<Option> declare(KeysOptions& o) {
  return {
      {"subscriber", 0, "NAME",
       "who may read views and state, and send commands;\nmay be repeated, and added later "
       "(default: "
       "one named\nsubscriber in a new FOLDER)",
       list_option(o.request.subscribers)},
      {"read-only", 0, "", "these subscribers may not send commands", flag_option(o.read_only)},
      domain_option(o.domain),
      prefix_option(o.prefix),
      {"days", 0, "N",
       "for how long (default " + std::to_string(o.request.days) +
           "), not longer than a\nFOLDER that they are added to",
       [&o](const std::string& v) {
         return parse_whole("days", v).and_then([&o](int days) -> Result<> {
           o.request.days = days;
           if (days >= 1 && days <= kMaxDays) return {};
           return fail("--days must be 1 to " + std::to_string(kMaxDays));
         });
       }},
      {"replace", 0, "", "replace existing keys: of the subscribers named, or all\nof FOLDER",
       flag_option(o.request.replace)},
  };
}

constexpr const char* kDdsKeysUsage =
    "Usage: orbwatch dds-keys FOLDER [options]\n\n"
    "Makes keys, certificates and signed permissions for a DDS domain that nobody else can\n"
    "read or command. FOLDER/enclaves/appliance is for orbwatchd ([dds.security] of its\n"
    "configuration), FOLDER/enclaves/NAME for a subscriber (--security of orbwatch subscribe,\n"
    "state and command). Whoever has FOLDER/private can let anybody in: keep it elsewhere.\n\n";

/// Returns the new folders, one per line.
CliResult<std::string> make_keys(KeysOptions& o, const std::vector<std::string>& words) {
  if (words.size() != 1 || words.front().empty()) {
    return usage_error("say which FOLDER to make keys in, and one only");
  }
  if (const auto checked = dds::check_topic_path(o.prefix, "prefix"); !checked) {
    return tl::unexpected(checked.error());
  }
  o.request.folder = words.front();
  o.request.domains = {o.domain, o.domain};
  o.request.appliance = appliance_access(o.prefix);
  o.request.subscriber = o.read_only ? reader_access(o.prefix) : controller_access(o.prefix);
  o.request.bulk_topics = bulk_topics(o.prefix);
  const auto now = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
  const auto made = make_keys(o.request, now);
  if (!made) return tl::unexpected(made.error());
  std::string folders;
  for (const auto& folder : *made) folders += folder.string() + "\n";
  return folders;
}

}  // namespace

CliResult<std::string> dds_keys_command(const Arguments& arguments) {
  KeysOptions o;
  return run_command(arguments,
                     {.usage = kDdsKeysUsage, .options = declare(o), .takes_words = true},
                     [&](const auto& words) { return make_keys(o, words); });
}

}  // namespace orbwatch::app::cli
