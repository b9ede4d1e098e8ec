// SPDX-License-Identifier: Apache-2.0
#include <sys/mman.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

#include "hal/mcap/completion.h"
#include "hal/mcap/crc32.h"
#include "hal/mcap/reader.h"
#include "hal/thread/file_descriptor.h"
#include "tests/fuzz/stop.h"

extern "C" int __sanitizer_install_malloc_and_free_hooks(void (*on_malloc)(const volatile void*,
                                                                           std::size_t),
                                                         void (*on_free)(const volatile void*));
extern "C" std::size_t __sanitizer_get_allocated_size(const volatile void* block);

/// Any bytes as a recording: it is refused in one sentence, or read to its end, before and after
/// its completion, and never costs more memory than stated.
///
/// An input is tried as it is, and with right CRCs, which chance would hardly find.
namespace orbwatch::fuzz {
namespace {

using namespace hal::mcap;

/// Small, so that inputs reach them.
constexpr Limits kLimits{.chunk = 16 << 10, .attachment = 4 << 10, .summary = 4 << 10};
/// Contexts of zstd, and the reader itself.
constexpr std::size_t kBeside = 512 << 10;

/// Allocated bytes of the running input, and the most of them.
std::atomic<std::ptrdiff_t> allocated{0}, peak{0};

void on_malloc(const volatile void*, std::size_t size) {
  allocated += static_cast<std::ptrdiff_t>(size);
  if (allocated > peak) peak = allocated.load();
}
void on_free(const volatile void* block) {
  if (block == nullptr) return;
  allocated -= static_cast<std::ptrdiff_t>(__sanitizer_get_allocated_size(block));
}

void expect_sentence(const FileError& error) {
  require(!error.message.empty(), "no reason");
  require(error.message.find('\n') == std::string::npos, "more than one line");
}

/// Reads all that a recording holds. Returns the number of messages that can be read.
std::size_t read_all(const std::filesystem::path& path) {
  auto reader = Reader::open(path, kLimits);
  if (!reader) {
    expect_sentence(reader.error());
    return 0;
  }
  std::size_t messages = 0;
  for (std::size_t k = 0; k < reader->summary().chunks.size(); ++k) {
    if (auto loaded = reader->load_chunk(k); !loaded) expect_sentence(loaded.error());
    while (const auto message = reader->next()) {
      require(reader->summary().channels.contains(message->head.channel_id), "unknown channel");
      ++messages;
    }
  }
  for (std::size_t k = 0; k < reader->summary().attachments.size(); ++k) {
    const auto attachment = reader->attachment(k);
    if (!attachment) {
      expect_sentence(attachment.error());
      continue;
    }
    const std::filesystem::path name = attachment->name;
    require(name.is_relative() && name == name.lexically_normal() && *name.begin() != "..",
            "a name that leaves its folder");
  }
  for (std::size_t k = 0; k < reader->summary().metadata.size(); ++k) {
    if (const auto metadata = reader->metadata(k); !metadata) expect_sentence(metadata.error());
  }
  return messages;
}

/// The same bytes with right CRCs of uncompressed chunks, attachments and the summary.
Bytes sealed(Bytes bytes) {
  std::uint64_t summary = 0;
  const auto set_crc = [&](std::size_t at, std::size_t begin, std::size_t end) {
    FieldWriter fields(bytes);
    fields.set(at, crc32_of(std::span(bytes).subspan(begin, end - begin)));
  };
  const auto seal = [&](const RecordView& view) -> FileResult<> {
    const auto begin = static_cast<std::size_t>(view.offset) + kRecordHead;
    const std::size_t end = begin + view.content.size();
    std::span<const std::byte> rest;
    if (view.opcode == Opcode::DataEnd) summary = end;
    if (view.opcode == Opcode::Chunk && parse<ChunkHead>(view, &rest)) {
      set_crc(begin + 24, end - rest.size(), end);
    } else if (view.opcode == Opcode::Attachment && view.content.size() >= 4) {
      set_crc(end - 4, begin, end - 4);
    } else if (view.opcode == Opcode::Footer && view.content.size() == 20 && summary != 0) {
      set_crc(end - 4, summary, end - 4);
    }
    return {};
  };
  if (bytes.size() <= kMagic.size()) return bytes;
  const Bytes records(bytes.begin() + kMagic.size(), bytes.end());
  // The magic at the end is no record, and ends the walk.
  static_cast<void>(for_each_record(records, kMagic.size(), seal));
  return bytes;
}

void try_recording(std::span<const std::byte> bytes) {
  const hal::FileDescriptor file(::memfd_create("fuzz", MFD_CLOEXEC));
  require(::write(file.get(), bytes.data(), bytes.size()) == std::ssize(bytes), "no file");
  const std::filesystem::path path = "/proc/self/fd/" + std::to_string(file.get());
  const std::size_t before = read_all(path);
  const auto completion = complete(path, kLimits);
  if (!completion) {
    expect_sentence(completion.error());
    return;
  }
  const std::size_t after = read_all(path);
  require(after == before, "completing changed the messages");
  if (!completion->was_finished) require(completion->messages == after, "messages miscounted");
  const auto again = complete(path, kLimits);
  require(again && again->was_finished, "completed, but not finished");
}

}  // namespace
}  // namespace orbwatch::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace orbwatch::fuzz;
  static const int hooks = __sanitizer_install_malloc_and_free_hooks(on_malloc, on_free);
  require(hooks != 0, "memory is not counted");
  const auto bytes = std::as_bytes(std::span(data, size));
  allocated = peak = 0;
  try_recording(bytes);
  try_recording(sealed({bytes.begin(), bytes.end()}));
  require(peak <= std::ptrdiff_t{most_memory(kLimits) + kBeside}, "more memory than stated");
  return 0;
}
