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
  return hal::read_regular_file(file).map(
      [](const std::string& text) { return text.substr(0, text.find_first_of("\r\n")); });
}

}  // namespace

Result<std::string> new_passphrase(const std::filesystem::path& file) {
  auto typed = read(file, ask_new_secret);
  if (!typed) return typed;
  const auto right = web::check_password(*typed);
  if (!right) return fail("the passphrase: " + right.error().message);
  return typed;
}

Result<std::string> passphrase(const std::filesystem::path& file) { return read(file, ask_secret); }

}  // namespace orbwatch::app::cli::backup
