// SPDX-License-Identifier: Apache-2.0
#include "app/cli/backup/passphrase.h"

#include <unistd.h>

#include "app/cli/secret_prompt.h"
#include "app/ports/web/access/login/secret.h"
#include "hal/regular_file.h"

namespace orbwatch::app::cli::backup {
namespace {

using Ask = Result<std::string> (*)(const std::string& what);

Result<std::string> read(const std::filesystem::path& file, Ask ask) {
  if (file.empty()) {
    if (::isatty(STDIN_FILENO) != 0) return ask("Passphrase of the backup");
    return fail("there is no terminal to ask for the passphrase; pass --passphrase-file FILE");
  }
  return hal::read_regular_file(file).map(passphrase_in);
}

}  // namespace

std::string_view without_mark(std::string_view text) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  if (text.starts_with(kMark)) text.remove_prefix(kMark.size());
  return text;
}

std::string passphrase_in(std::string_view text) {
  const std::string_view all = without_mark(text);
  return std::string(all.substr(0, all.find_first_of("\r\n")));
}

Result<std::string> new_passphrase(const std::filesystem::path& file) {
  auto typed = read(file, ask_new_secret);
  if (!typed) return typed;
  const auto right = web::check_password(*typed);
  if (!right) return fail("the passphrase: " + right.error().message);
  return typed;
}

Result<std::string> passphrase(const std::filesystem::path& file) { return read(file, ask_secret); }

}  // namespace orbwatch::app::cli::backup
