#include "app/ports/dds/security/key_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

namespace orbwatch::app {
namespace {

constexpr std::size_t kMost = 1 << 20;

class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  int get() const { return number_; }

 private:
  int number_;
};

tl::unexpected<Error> cannot(const std::filesystem::path& file, const char* what) {
  return fail(file.string() + ": cannot be " + what + ": " + std::strerror(errno));
}

bool write_all(int file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(file, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

}  // namespace

Result<std::string> read_key_file(const std::filesystem::path& file) {
  // A pipe would be waited for.
  const Descriptor in(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (in.get() < 0) return cannot(file, "read");
  std::string text;
  std::array<char, 4096> block;
  while (true) {
    const ssize_t count = ::read(in.get(), block.data(), block.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return cannot(file, "read");
    if (count == 0) return text;
    text.append(block.data(), static_cast<std::size_t>(count));
    if (text.size() > kMost) return fail(file.string() + ": is larger than 1 MiB, so no such file");
  }
}

Result<> write_key_file(const std::filesystem::path& file, std::string_view text,
                        Readable readable) {
  const mode_t mode = readable == Readable::Owner ? 0600 : 0644;
  const Descriptor out(::open(file.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, mode));
  if (out.get() < 0 || !write_all(out.get(), text) || ::fsync(out.get()) != 0) {
    return cannot(file, "written");
  }
  return {};
}

}  // namespace orbwatch::app
