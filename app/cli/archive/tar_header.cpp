// SPDX-License-Identifier: Apache-2.0
#include "app/cli/archive/tar_header.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>

#include "app/cli/archive/archive.h"

namespace orbwatch::app::cli {
namespace {

constexpr std::uint64_t kMostOctalSize = (std::uint64_t{1} << 33) - 1;  ///< 11 digits
constexpr std::uint64_t kMostSize = (std::uint64_t{1} << 63) - 1;       ///< largest size of a file
constexpr unsigned char kBinary = 0x80;  ///< first byte of a number that is not octal text
constexpr std::string_view kMagic("ustar\00000", 8);  // and the version
constexpr char kRegular = '0', kRegularOfOld = '\0';
constexpr mode_t kPermissions = 07777;

/// Numbers are octal text, texts end with a zero unless they fill their field. A larger size is a
/// binary number, as GNU tar, bsdtar and star write it.
struct TarHeader {
  std::array<char, 100> name{};
  std::array<char, 8> mode{};
  std::array<char, 8> user{};
  std::array<char, 8> group{};
  std::array<char, 12> size{};
  std::array<char, 12> time{};
  std::array<char, 8> checksum{};
  char type = kRegular;
  std::array<char, 100> link{};
  std::array<char, 8> magic{};
  std::array<char, 32> user_name{};
  std::array<char, 32> group_name{};
  std::array<char, 8> device_major{};
  std::array<char, 8> device_minor{};
  std::array<char, 155> prefix{};  ///< folders in front of the name
  std::array<char, 12> padding{};
};
static_assert(sizeof(TarHeader) == kTarBlock && std::is_trivially_copyable_v<TarHeader>);

template <std::size_t N>
void put_number(std::array<char, N>& field, std::uint64_t number) {
  field.back() = '\0';
  for (std::size_t i = N - 1; i-- > 0; number >>= 3) {
    field[i] = static_cast<char>('0' + (number & 7U));
  }
}

/// Nullopt: not octal digits between spaces.
template <std::size_t N>
std::optional<std::uint64_t> number_in(const std::array<char, N>& field) {
  std::string_view text(field.data(), N);
  text = text.substr(0, text.find('\0'));
  text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
  text = text.substr(0, text.find_last_not_of(' ') + 1);
  constexpr std::size_t kMostDigits = 21;
  if (text.empty() || text.size() > kMostDigits) return std::nullopt;
  std::uint64_t number = 0;
  for (const char digit : text) {
    if (digit < '0' || digit > '7') return std::nullopt;
    number = number * 8 + static_cast<std::uint64_t>(digit - '0');
  }
  return number;
}

using SizeField = decltype(TarHeader::size);

void put_size(SizeField& field, std::uint64_t size) {
  if (size <= kMostOctalSize) {
    put_number(field, size);
    return;
  }
  for (std::size_t i = field.size(); i-- > 0; size >>= 8) field[i] = static_cast<char>(size);
  field.front() = static_cast<char>(kBinary);
}

/// Nullopt: neither octal digits between spaces nor a binary number up to kMostSize.
std::optional<std::uint64_t> size_in(const SizeField& field) {
  std::optional<std::uint64_t> size = number_in(field);
  if (static_cast<unsigned char>(field.front()) == kBinary) {
    size = 0;
    for (const char byte : std::span(field).subspan(1)) {
      if (*size > kMostSize >> 8) return std::nullopt;
      *size = *size << 8 | static_cast<unsigned char>(byte);
    }
  }
  return size && *size <= kMostSize ? size : std::nullopt;
}

template <std::size_t N>
std::string_view text_in(const std::array<char, N>& field) {
  const std::string_view all(field.data(), N);
  return all.substr(0, all.find('\0'));
}

/// Sum of all bytes, with spaces in the field of the sum.
std::uint64_t checksum_of_header(TarHeader header) {
  header.checksum.fill(' ');
  std::uint64_t sum = 0;
  for (const auto byte : std::bit_cast<std::array<unsigned char, kTarBlock>>(header)) sum += byte;
  return sum;
}

/// Splits a name at a slash so that both parts fit. False: there is no such slash.
bool put_name(TarHeader& header, std::string_view name) {
  if (name.size() <= header.name.size()) {
    std::ranges::copy(name, header.name.begin());
    return true;
  }
  const std::size_t slash = name.find('/', name.size() - header.name.size() - 1);
  if (slash == std::string_view::npos || slash > header.prefix.size()) return false;
  std::ranges::copy(name.substr(0, slash), header.prefix.begin());
  std::ranges::copy(name.substr(slash + 1), header.name.begin());
  return true;
}

}  // namespace

Result<std::string> tar_header(const TarEntry& entry, std::chrono::sys_seconds made) {
  TarHeader header;
  if (auto named = check_archived_name(entry.name); !named) return tl::unexpected(named.error());
  if (!put_name(header, entry.name)) return fail(entry.name + ": the name is too long");
  if (entry.size > kMostSize) return fail(entry.name + ": is too large");
  std::ranges::copy(kMagic, header.magic.begin());
  put_number(header.mode, entry.mode & kPermissions);
  put_number(header.user, 0);
  put_number(header.group, 0);
  put_size(header.size, entry.size);
  put_number(header.time, static_cast<std::uint64_t>(
                              std::max<std::int64_t>(made.time_since_epoch().count(), 0)));
  put_number(header.device_major, 0);
  put_number(header.device_minor, 0);
  put_number(header.checksum, checksum_of_header(header));
  return std::string(reinterpret_cast<const char*>(&header), kTarBlock);
}

Result<TarEntry> parse_tar_header(std::string_view block) {
  TarHeader header;
  if (block.size() != kTarBlock) return fail("is cut off");
  std::memcpy(&header, block.data(), kTarBlock);
  if (std::string_view(header.magic.data(), header.magic.size()) != kMagic ||
      number_in(header.checksum) != checksum_of_header(header)) {
    return fail("is damaged, or not an archive of this kind");
  }
  std::string name(text_in(header.prefix));
  if (!name.empty()) name += '/';
  name += text_in(header.name);
  if (auto named = check_archived_name(name); !named) return tl::unexpected(named.error());
  if (header.type != kRegular && header.type != kRegularOfOld) {
    return fail(name + ": is not a regular file");
  }
  const auto mode = number_in(header.mode), size = size_in(header.size);
  if (!mode || !size) return fail(name + ": mode or size is damaged");
  return TarEntry{std::move(name), *size, static_cast<mode_t>(*mode) & kPermissions};
}

}  // namespace orbwatch::app::cli
