// SPDX-License-Identifier: Apache-2.0
#include "app/cli/backup/backup_file.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <memory>
#include <system_error>
#include <utility>

#include "app/cli/archive/compression.h"
#include "app/cli/archive/tar.h"
#include "app/cli/backup/sealing.h"
#include "app/cli/backup/site_places.h"
#include "app/digest/sha256.h"
#include "hal/regular_file.h"
#include "hal/thread/file_descriptor.h"

namespace orbwatch::app::cli::backup {
namespace {

constexpr const char* kManifestName = "manifest.json";
constexpr const char* kSealedName = "secrets.sealed";

std::chrono::sys_seconds now() {
  return std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
}

/// The bytes of the sealed secrets. Former versions sealed with the byte order mark of a passphrase
/// file; it is tried second.
Result<std::string> unsealed(const ReadBackup& read, std::string_view passphrase) {
  auto bytes = unseal(read.sealed, passphrase, read.manifest_text);
  if (bytes) return bytes;
  return unseal(read.sealed, "\xEF\xBB\xBF" + std::string(passphrase), read.manifest_text);
}

/// The error of errno.
tl::unexpected<Error> unreadable(const std::filesystem::path& file) {
  return fail(file.string() + ": cannot be read: " + std::system_category().message(errno));
}

void complete(Manifest& manifest, const Backup& backup, bool is_sealed) {
  manifest.secrets = backup.secrets.empty() ? Secrets::None
                     : is_sealed            ? Secrets::Encrypted
                                            : Secrets::LeftOut;
  for (const ArchivedFile& file : backup.files) {
    manifest.files.push_back({file.name, sha256(file.bytes), file.bytes.size(), file.mode});
  }
  for (const ArchivedFile& file : backup.secrets) manifest.secret_files.push_back(file.name);
}

/// Error: the file is not the one of the manifest.
Result<> check_file(const ArchivedFile& file, const ManifestFile& stated) {
  if (file.name != stated.name) return fail("is damaged: " + stated.name + " is missing");
  if (auto placed = check_backed_up(file.name); !placed) return placed;
  if (file.bytes.size() == stated.size && file.mode == stated.mode &&
      sha256(file.bytes) == stated.sha256) {
    return {};
  }
  return fail("is damaged: " + file.name + " is not the file that was backed up");
}

/// Error of a backup that no device would read.
tl::unexpected<Error> too_large(const Archive& archive) {
  const auto largest = std::ranges::max_element(
      archive, {}, [](const ArchivedFile& file) { return file.bytes.size(); });
  return fail("the files are more than " + std::to_string(kMostBytes >> 20) +
              " MiB; remove large ones that are not part of the configuration, first " +
              largest->name);
}

/// The files between the manifest and the sealed ones.
Result<Archive> checked_files(Archive archive, const Manifest& manifest) {
  if (archive.size() != manifest.files.size())
    return fail("is damaged: files are missing or added");
  for (std::size_t i = 0; i < archive.size(); ++i) {
    if (auto right = check_file(archive[i], manifest.files[i]); !right) {
      return tl::unexpected(right.error());
    }
  }
  return archive;
}

}  // namespace

Result<std::string> backup_bytes(Backup backup, std::string_view passphrase) {
  complete(backup.manifest, backup, !passphrase.empty());
  const std::string text = manifest_text(backup.manifest);
  Archive archive{{kManifestName, text}};
  for (ArchivedFile& file : backup.files) archive.push_back(std::move(file));
  if (backup.manifest.secrets == Secrets::Encrypted) {
    auto sealed = tar_of(backup.secrets, now()).and_then([&](const std::string& tar) {
      return seal(tar, passphrase, text);
    });
    if (!sealed) return sealed;
    archive.push_back({kSealedName, std::move(*sealed)});
  }
  const auto tar = tar_of(archive, now());
  if (!tar) return tar;
  if (tar->size() > kMostBytes) return too_large(archive);
  return compressed(*tar);
}

Result<FrameReader> open_frames(const std::filesystem::path& file) {
  const auto opened = std::make_shared<const hal::FileDescriptor>(hal::open_no_link(file));
  struct stat about {};
  if (!opened->is_open() || ::fstat(opened->get(), &about) != 0) return unreadable(file);
  if (!S_ISREG(about.st_mode)) return fail(file.string() + ": is not a regular file");
  return FrameReader([opened, file](std::span<char> bytes) -> Result<std::size_t> {
    const ssize_t count = ::read(opened->get(), bytes.data(), bytes.size());
    if (count < 0) return unreadable(file);
    return static_cast<std::size_t>(count);
  });
}

Result<ReadBackup> read_backup(FrameReader& frames) {
  const auto has_one = frames.next();
  if (!has_one) return tl::unexpected(has_one.error());
  if (!*has_one) return fail("is empty");
  const auto tar = frames.read_all(kMostBytes);
  if (!tar) return tl::unexpected(tar.error());
  auto read = parse_backup_tar(*tar);
  if (!read) return read;
  const auto has_more = frames.next();
  if (!has_more) return tl::unexpected(has_more.error());
  const bool has_events = !read->backup.manifest.events.empty();
  if (*has_more && !has_events) return fail("is damaged: other bytes follow it");
  if (!*has_more && has_events) return fail("is cut off: its events are missing");
  return read;
}

Result<ReadBackup> parse_backup_tar(std::string_view tar) {
  auto archive = parse_tar(tar);
  if (!archive) return tl::unexpected(archive.error());
  if (archive->empty() || archive->front().name != kManifestName) {
    return fail("is not a backup: it has no manifest");
  }
  ReadBackup read;
  read.manifest_text = std::move(archive->front().bytes);
  auto manifest = parse_manifest(read.manifest_text);
  if (!manifest) return tl::unexpected(manifest.error());
  archive->erase(archive->begin());
  if (manifest->secrets == Secrets::Encrypted) {
    if (archive->empty() || archive->back().name != kSealedName) {
      return fail("is damaged: its secrets are missing");
    }
    read.sealed = std::move(archive->back().bytes);
    archive->pop_back();
  }
  auto files = checked_files(std::move(*archive), *manifest);
  if (!files) return tl::unexpected(files.error());
  read.backup = {std::move(*manifest), std::move(*files), {}};
  return read;
}

Result<> open_secrets(ReadBackup& read, std::string_view passphrase) {
  auto archive =
      unsealed(read, passphrase).and_then([](const std::string& tar) { return parse_tar(tar); });
  if (!archive) return tl::unexpected(archive.error());
  const auto& names = read.backup.manifest.secret_files;
  bool is_right = archive->size() == names.size();
  for (std::size_t i = 0; is_right && i < names.size(); ++i) {
    is_right = (*archive)[i].name == names[i] && check_backed_up(names[i]).has_value();
  }
  if (!is_right) return fail("is damaged: its secrets are not those of the manifest");
  read.backup.secrets = std::move(*archive);
  return {};
}

}  // namespace orbwatch::app::cli::backup
