// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/export/export_file.h"

namespace orbwatch::app::recorder {
namespace {

Result<> without_number(const hal::mcap::FileResult<>& result) {
  if (!result) return fail(result.error().message);
  return {};
}

}  // namespace

Result<ExportFile> ExportFile::create(const std::filesystem::path& path) {
  auto file = hal::mcap::File::open(path, hal::mcap::File::Access::Create);
  if (!file) return fail(file.error().message);
  return ExportFile(std::move(*file));
}

Result<> ExportFile::append(std::span<const std::byte> bytes) {
  const auto written = file_.write(size_, {bytes});
  if (written) size_ += bytes.size();
  return without_number(written);
}

Result<> ExportFile::replace(std::uint64_t offset, std::span<const std::byte> bytes) {
  return without_number(file_.write(offset, {bytes}));
}

Result<> ExportFile::sync() const { return without_number(file_.sync()); }

}  // namespace orbwatch::app::recorder
