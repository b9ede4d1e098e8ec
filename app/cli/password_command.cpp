// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include <filesystem>
#include <iostream>
#include <optional>
#include <string>

#include "app/cli/command.h"
#include "app/cli/options/options.h"
#include "app/cli/secret_prompt.h"
#include "app/files/resolve.h"
#include "app/files/runtime/site_file.h"
#include "app/ports/web/access/login/first_code.h"
#include "app/ports/web/access/login/secret.h"
#include "app/ports/web/access/users.h"
#include "app/ports/web/tls/server_certificate.h"
#include "app/state/state_folder.h"

namespace orbwatch::app::cli {
namespace {

constexpr const char* kPasswordUsage =
    "Usage: orbwatch password [NAME] [options]\n\n"
    "Sets the password of a user of the page and its HTTP interface (default: admin), or makes\n"
    "the user; with the first one there, nobody sees or does anything there without logging in.\n"
    "A forgotten password is replaced in this way, without loss of anything else. It is asked\n"
    "for twice on a terminal, or is a line of standard input. A running orbwatchd takes it up\n"
    "by itself, and ends waits after wrong passwords.\n\n"
    "With --show it changes nothing, and prints the fingerprint of the certificate of HTTPS, to\n"
    "compare with the browser's, and while no password is set the code with which a browser on\n"
    "another computer sets the first one.\n\n";

struct PasswordOptions {
  std::filesystem::path config;
  std::optional<Role> role;
  bool show = false;
};

Result<std::string> read_password(const std::string& name) {
  std::string line;
  if (::isatty(STDIN_FILENO) == 0) {
    if (std::getline(std::cin, line)) return line;
    return fail("standard input has no line with the password");
  }
  return ask_new_secret("New password of " + name);
}

/// Role of a new user; the first user is administrator.
std::optional<Role> role_of_new(const web::Users& users) {
  return users.users.empty() ? std::optional(Role::Administrator) : std::nullopt;
}

Result<std::string> certificate_line(const WebSettings& web, const std::filesystem::path& folder) {
  if (!https_port_of(web)) return "HTTPS: not served; `address` of [web] is one of loopback\n";
  if (!web.certificate.empty()) {
    return web::named_certificate(web, now_for(Dates::Ignored)).map([](const auto& named) {
      return "HTTPS: " + certificate_text(named) + "\n";
    });
  }
  return web::kept_certificate(folder).map([](const auto& kept) {
    return "HTTPS: " + (kept ? certificate_text(*kept) : "no certificate yet; orbwatchd makes it") +
           "\n";
  });
}

Result<std::string> first_password_line(const std::filesystem::path& folder) {
  const auto users = web::load_users(web::users_file(folder));
  if (!users) return tl::unexpected(users.error());
  if (*users) return "first password: set\n";
  return web::kept_code(folder).map([](const auto& code) {
    return "first password: not set; " +
           (code ? "code for another computer " + *code : "no code for other computers") + "\n";
  });
}

Result<std::string> show(const PasswordOptions& o) {
  const auto site = files::read_site(files::site_file(o.config));
  if (!site) return tl::unexpected(site.error());
  const auto folder = state_folder(site->state_folder, files::site_file(o.config));
  if (!folder) return tl::unexpected(folder.error());
  const auto certificate = certificate_line(std::get<WebSettings>(site->sinks), *folder);
  if (!certificate) return certificate;
  return first_password_line(*folder).map(
      [&](const std::string& password) { return *certificate + password; });
}

Result<std::string> set_password(const PasswordOptions& o, const std::string& name) {
  if (auto named = web::check_name(name); !named) return tl::unexpected(named.error());
  const auto site = files::read_site(files::site_file(o.config));
  if (!site) return tl::unexpected(site.error());
  const auto folder = state_folder(site->state_folder, files::site_file(o.config));
  if (!folder) return tl::unexpected(folder.error());
  const auto password = read_password(name);
  if (!password) return password;
  if (auto right = web::check_password(*password); !right) return tl::unexpected(right.error());
  const auto hash = web::hash_password(*password);
  if (!hash) return hash;
  const auto file = web::users_file(*folder);
  const auto changed = web::change_users(file, [&](web::Users& users) -> Result<> {
    const bool is_new = users.find(name) == nullptr;
    const auto role = is_new && !o.role ? role_of_new(users) : o.role;
    if (is_new && !role) {
      return fail("there is no user " + name + "; --role makes a new one");
    }
    return web::set_user(users, name, role, *hash);
  });
  if (!changed) return tl::unexpected(changed.error());
  return "the password of " + name + " is set, in " + file.string() + "\n";
}

}  // namespace

CliResult<std::string> password_command(const Arguments& arguments) {
  PasswordOptions o;
  const auto set_role = [&o](const std::string& word) -> Result<> {
    const auto role = web::parse_role(word);
    if (!role) return tl::unexpected(role.error());
    o.role = *role;
    return {};
  };
  return run_command(
      arguments,
      {.usage = kPasswordUsage,
       .options = {{"config", 'c', "SITE", "the file that orbwatchd runs (default: as orbwatchd)",
                    text_option(o.config)},
                   {"role", 'r', "ROLE",
                    joined(kRoles) + "\n(default: as before; the first user is administrator)",
                    set_role},
                   {"show", 0, "", "print fingerprint and code only", flag_option(o.show)}},
       .takes_words = true},
      [&](const std::vector<std::string>& words) -> CliResult<std::string> {
        if (words.size() > 1) return usage_error("say one NAME only");
        if (o.show) return show(o);
        return set_password(o, words.empty() ? std::string(web::kFirstUser) : words.front());
      });
}

}  // namespace orbwatch::app::cli
