// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/device/device_desk.h"

#include <chrono>
#include <string_view>
#include <system_error>
#include <utility>

#include "app/model/status/utc_text.h"
#include "app/ports/web/access/base64.h"
#include "app/ports/web/api/record_schema.h"
#include "hal/host.h"

namespace orbwatch::app::web {
namespace {

constexpr const char* kNoDevice = "there is no state folder of this configuration";
constexpr const char* kNoImage =
    "this computer does not run an image with two slots; update its packages";
constexpr const char* kAnotherBackup = "another backup was uploaded meanwhile; check it first";
/// RFC 8878.
constexpr std::string_view kZstd = "application/zstd";

Answered<ContentsAnswer> contents_of(const Result<std::string>& json) {
  if (!json) return refuse(json.error());
  return parse_record<ContentsAnswer>(*json).map_error(
      [](const Error& error) { return error_response(500, error.message); });
}

/// Name of a downloaded file: letters, digits and "-_." only.
std::string download_name(DeviceFile kind) {
  std::string name = hal::host_name() + "-" + std::string(word_for(kDeviceFiles, kind)) + "-" +
                     utc_text(std::chrono::system_clock::now()).value_or("").substr(0, 19) +
                     ".tar.zst";
  std::erase_if(name, [](char c) {
    const bool is_plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') ||
                          (c >= 'A' && c <= 'Z') || c == '-' || c == '_' || c == '.';
    return !is_plain;
  });
  return name;
}

std::string origin_of(const ContentsAnswer& contents) {
  return "backup of " + contents.host + ", " + contents.made;
}

}  // namespace

Answered<MadeAnswer> DeviceDesk::keep(DeviceFile kind, const Result<DeviceFiles::Made>& made) {
  if (!made) return refuse(made.error());
  std::error_code error;
  const auto bytes = std::filesystem::file_size(made->file, error);
  if (error) return refuse(409, made->file.string() + ": " + error.message());
  (*made_)[kind] = made->file;
  return MadeAnswer{bytes, made->report};
}

Answered<MadeAnswer> DeviceDesk::make_support(Change<SupportBody>& change) {
  change.after = change.body.pictures ? "with pictures" : "without pictures";
  if (!device_) return refuse(404, kNoDevice);
  return keep(DeviceFile::Support, device_->support(figures_(), change.body.pictures));
}

Answered<MadeAnswer> DeviceDesk::make_backup(Change<BackupBody>& change) {
  change.after = change.body.passphrase ? "secrets encrypted" : "without secrets";
  if (change.body.events) change.after += ", with events";
  if (!device_) return refuse(404, kNoDevice);
  return keep(DeviceFile::Backup, device_->backup(change.body.passphrase, change.body.events));
}

void DeviceDesk::download(const DeviceFileQuery& query, const ExchangePtr& exchange) {
  changes_.read(exchange, [made = made_, kind = query.file] {
    const auto found = made->find(kind);
    if (found == made->end()) return error_response(404, "none was made yet");
    const auto file = open_file(found->second);
    if (!file) return error_response(404, file.error().message);
    Response response = file_response(kZstd, *file);
    response.headers.emplace_back("Content-Disposition",
                                  "attachment; filename=\"" + download_name(kind) + "\"");
    return response;
  });
}

Answered<UploadAnswer> DeviceDesk::upload(Change<UploadBody>& change) {
  const auto& [offset, text] = change.body;
  change.changes_nothing = offset != 0;  // one line for a whole file
  change.after = "begun";
  if (!device_) return refuse(404, kNoDevice);
  const auto bytes = bytes_of_base64(text);
  if (!bytes) return refuse(400, "bytes is not Base64 with padding");
  const auto size = device_->upload(offset, *bytes);
  if (!size) return refuse(size.error());
  if (offset == 0) uploaded_.restart();
  uploaded_.add(*bytes);
  return UploadAnswer{*size};
}

Answered<CheckAnswer> DeviceDesk::check(Change<DeviceFiles::Restore>& change) {
  change.changes_nothing = true;
  if (!device_) return refuse(404, kNoDevice);
  return contents_of(device_->check(change.body)).map([this](ContentsAnswer contents) {
    return CheckAnswer{std::move(contents), uploaded_.digits()};
  });
}

/// Error: a configuration is on trial, and would be reverted to files that are replaced.
Answered<Nothing> DeviceDesk::check_replaceable() const {
  if (!device_) return refuse(404, kNoDevice);
  if (!files_) return Nothing{};
  const auto state = files_->read();
  if (!state || !state->trial) return Nothing{};
  return refuse(409, "a configuration is on trial; confirm or revert it first");
}

Answered<ContentsAnswer> DeviceDesk::restore(Change<RestoreBody>& change) {
  if (const auto may = check_replaceable(); !may) return tl::unexpected(may.error());
  const RestoreBody& body = change.body;
  if (body.sha256 && *body.sha256 != uploaded_.digits()) return refuse(409, kAnotherBackup);
  auto contents = contents_of(device_->restore(body.restore));
  if (!contents) return contents;
  change.after = origin_of(*contents);
  device_->restart();
  return contents;
}

Answered<Done> DeviceDesk::reset(Change<ResetBody>& /*change*/) {
  if (const auto may = check_replaceable(); !may) return tl::unexpected(may.error());
  if (const auto done = device_->reset(); !done) return refuse(done.error());
  device_->restart();
  return Done{};
}

void DeviceDesk::update(const ExchangePtr& exchange) {
  changes_.read(exchange, [update = update_] {
    UpdateAnswer answer;
    answer.has_slots = update != nullptr;
    if (update) answer.state = update->state();
    return json_response(json_text(json_of(answer)));
  });
}

Answered<UploadAnswer> DeviceDesk::upload_update(Change<UploadUpdateBody>& change) {
  const auto& [offset, whole, text] = change.body;
  change.changes_nothing = offset != 0;  // one line for a whole file
  change.after = "begun, " + std::to_string(whole) + " bytes";
  if (!update_) return refuse(404, kNoImage);
  const auto bytes = bytes_of_base64(text);
  if (!bytes) return refuse(400, "bytes is not Base64 with padding");
  const auto size = update_->upload(offset, whole, *bytes);
  if (!size) return refuse(size.error());
  return UploadAnswer{*size};
}

Answered<Done> DeviceDesk::install_update(Change<Nothing>& change) {
  if (!update_) return refuse(404, kNoImage);
  change.after = "begun";
  if (const auto begun = update_->install(); !begun) return refuse(begun.error());
  return Done{};
}

Answered<Done> DeviceDesk::restart_device(Change<Nothing>& change) {
  if (!update_) return refuse(404, kNoImage);
  change.after = "tries " + update_->state().other;
  if (const auto done = update_->restart_device(); !done) return refuse(done.error());
  return Done{};
}

void DeviceDesk::cancel() {
  if (device_) device_->cancel();
  if (update_) update_->cancel();
}

}  // namespace orbwatch::app::web
