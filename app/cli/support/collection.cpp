// SPDX-License-Identifier: Apache-2.0
#include "app/cli/support/collection.h"

#include <chrono>
#include <utility>

#include "app/model/status/utc_text.h"
#include "hal/host.h"

namespace orbwatch::app::cli::support {
namespace {

constexpr std::size_t kMostBytes = std::size_t{128} << 20;

std::string contents_text(const SupportFile& file, std::size_t changed) {
  std::string text = "Support file of orbwatch, made by orbwatch support on " + hal::host_name() +
                     ", " + utc_text(std::chrono::system_clock::now()).value_or("") +
                     "\n\nFiles:\n";
  for (const ArchivedFile& one : file.files) {
    text.append("  ").append(one.name).append(", ");
    text.append(std::to_string(one.bytes.size())).append(" bytes\n");
  }
  text += "\nLeft out:\n";
  for (const auto& [name, reason] : file.left_out) {
    text.append("  ").append(name).append(": ").append(reason).append("\n");
  }
  return text +
         "\nSecrets are removed: passwords and their hashes, keys, tokens, codes, and the comments "
         "of\nthe configuration. Files from which something was removed, marked " +
         std::string(kRemoved) + ": " + std::to_string(changed) + "\n";
}

}  // namespace

Collection::Collection(const KnownSecrets& secrets) : redaction_(secrets.values) {
  for (const std::string& reason : secrets.unread) {
    leave_out("secrets to be removed", reason + "; run as root");
  }
}

void Collection::add(const std::string& name, const Result<std::string>& text) {
  if (!text) return leave_out(name, text.error().message);
  std::string clean = redaction_(*text);
  if (clean != *text) ++changed_;
  store({name, std::move(clean)});
}

void Collection::add_picture(const std::string& name, Result<std::string> picture) {
  if (!picture) return leave_out(name, picture.error().message);
  store({name, std::move(*picture)});
}

void Collection::leave_out(const std::string& name, const std::string& reason) {
  file_.left_out.push_back({redaction_(name), redaction_(reason)});
}

void Collection::store(ArchivedFile file) {
  if (auto named = check_archived_name(file.name); !named) {
    return leave_out("a file", named.error().message);
  }
  if (file.bytes.size() > kMostBytes - size_)
    return leave_out(file.name, "the file would be too large");
  size_ += file.bytes.size();
  file_.files.push_back(std::move(file));
}

SupportFile Collection::finish() && {
  std::string contents = contents_text(file_, changed_);
  file_.files.insert(file_.files.begin(), {"contents.txt", std::move(contents)});
  return std::move(file_);
}

}  // namespace orbwatch::app::cli::support
