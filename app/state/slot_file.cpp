// SPDX-License-Identifier: Apache-2.0
#include "app/state/slot_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>
#include <zlib.h>

#include <bit>
#include <cerrno>
#include <span>
#include <string_view>
#include <system_error>
#include <utility>

#include "hal/atomic_file.h"

namespace orbwatch::app {
namespace {

static_assert(std::endian::native == std::endian::little, "a file moves between our targets");

constexpr std::array<char, 8> kMagic{'o', 'r', 'b', 's', 't', 'a', 't', 'e'};

constexpr const char* kNeed =
    "; orbwatchd needs a state_folder that it may write to, with 16 KiB free";

std::uint32_t checksum_of(std::uint64_t number, const SlotFile::Content& content) {
  const auto crc = crc32_z(0, reinterpret_cast<const Bytef*>(&number), sizeof number);
  return static_cast<std::uint32_t>(
      crc32_z(crc, reinterpret_cast<const Bytef*>(content.data()), content.size()));
}

/// Writes all bytes from `offset` on; false: failed, errno is set.
bool write_all(int file, std::span<const std::byte> bytes, off_t offset) {
  while (!bytes.empty()) {
    const ssize_t count = ::pwrite(file, bytes.data(), bytes.size(), offset);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(count));
    offset += count;
  }
  return true;
}

/// Reads up to the end of the file; false: failed, errno is set.
bool read_all(int file, std::span<std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::read(file, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return count == 0;
    bytes = bytes.subspan(static_cast<std::size_t>(count));
  }
  return true;
}

}  // namespace

Result<std::unique_ptr<SlotFile>> SlotFile::open(const std::filesystem::path& file) {
  std::unique_ptr<SlotFile> opened(new SlotFile(file));
  if (auto locked = opened->lock(); !locked) return tl::unexpected(locked.error());
  std::error_code ignored;  // a file that cannot be looked up cannot be created either
  if (!std::filesystem::exists(file, ignored)) {
    if (auto created = opened->create(); !created) return tl::unexpected(created.error());
  }
  if (auto loaded = opened->load(); !loaded) return tl::unexpected(loaded.error());
  return opened;
}

Result<> SlotFile::lock() {
  const std::filesystem::path folder = path_.parent_path();
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  folder_ = hal::FileDescriptor(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!folder_.is_open()) {
    return fail(folder.string() + ": cannot be opened: " + std::system_category().message(errno) +
                "; state_folder of the site file must be writable for orbwatchd");
  }
  if (::flock(folder_.get(), LOCK_EX | LOCK_NB) == 0) return {};
  if (errno != EWOULDBLOCK) return tl::unexpected(error("be locked"));
  return fail(folder.string() +
              ": is used by another orbwatchd; set a different state_folder for each");
}

/// A file that exists is whole, or was damaged later.
Result<> SlotFile::create() const {
  const Slot slot{{kMagic, kVersion, checksum_of(0, {}), 0}, {}};
  const std::array slots{slot, slot};
  const std::string_view bytes(reinterpret_cast<const char*>(slots.data()), sizeof slots);
  return hal::write_file(path_, bytes, hal::FileAccess::Folder).map_error([](const Error& error) {
    return Error{error.message + kNeed};
  });
}

Result<> SlotFile::load() {
  file_ = hal::FileDescriptor(::open(path_.c_str(), O_RDWR | O_CLOEXEC));
  if (!file_.is_open()) return tl::unexpected(error("be opened for writing"));
  std::array<Slot, 2> slots{};  // the missing part of a short file stays zero, which is not valid
  if (!read_all(file_.get(), std::as_writable_bytes(std::span(slots)))) {
    return tl::unexpected(error("be read"));
  }
  const Slot* newest = nullptr;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    const auto& [header, content] = slots[i];
    const bool is_valid =
        header.magic == kMagic && header.checksum == checksum_of(header.number, content);
    if (!is_valid || (newest != nullptr && newest->header.number >= header.number)) continue;
    newest = &slots[i];
    number_ = header.number;
    next_ = 1 - i;
  }
  if (newest == nullptr) {
    content_ = fail(path_.string() + ": is damaged in both slots");
  } else if (newest->header.version != kVersion) {
    content_ = fail(path_.string() + ": is of version " + std::to_string(newest->header.version) +
                    "; this orbwatchd reads version " + std::to_string(kVersion));
  } else {
    content_ = newest->content;
  }
  return {};
}

Result<> SlotFile::write(const Content& content) {
  const std::uint64_t number = number_ + 1;
  const Slot slot{{kMagic, kVersion, checksum_of(number, content), number}, content};
  const auto offset = static_cast<off_t>(next_ * kSlotSize);
  if (!write_all(file_.get(), std::as_bytes(std::span(&slot, 1)), offset) ||
      ::fdatasync(file_.get()) != 0) {
    return tl::unexpected(error("be written"));
  }
  content_ = content;
  number_ = number;
  next_ = 1 - next_;
  return {};
}

Error SlotFile::error(const std::string& what) const {
  return {path_.string() + ": cannot " + what + ": " + std::system_category().message(errno) +
          "; orbwatchd needs a writable state_folder with 16 KiB free"};
}

}  // namespace orbwatch::app
