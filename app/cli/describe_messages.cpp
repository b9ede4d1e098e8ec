#include <filesystem>
#include <span>
#include <system_error>

#include "app/cli/describe.h"
#include "app/cli/options.h"
#include "app/dds/ros/message_package.h"
#include "app/pictures/picture_file.h"

namespace orbwatch::app {
namespace {

Result<> write_package(const std::vector<PackageFile>& files, const std::filesystem::path& folder) {
  for (const PackageFile& file : files) {
    const std::filesystem::path path = folder / file.path;
    std::error_code error;
    std::filesystem::create_directories(path.parent_path(), error);
    if (error) return fail(path.parent_path().string() + ": " + error.message());
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(file.text.data());
    if (auto written = write_file(path, {bytes, file.text.size()}); !written) return written;
  }
  return {};
}

}  // namespace

Result<std::string> describe_messages(const std::vector<std::string>& arguments) {
  std::filesystem::path folder;
  bool asks_help = false;
  const std::vector<Option> options{
      {"output", 'o', "FOLDER", "write the package's files there instead", text_option(folder)},
      {"help", 'h', "", "this text", flag_option(asks_help)}};
  const auto rest = parse_options(arguments, options);
  if (!rest) return tl::unexpected(rest.error());
  if (asks_help) return "Usage: orbwatch describe messages [options]\n\n" + options_help(options);
  if (!rest->empty()) return fail("unexpected argument " + rest->front() + "; see --help");
  const auto files = message_package();
  if (!files) return tl::unexpected(files.error());
  if (!folder.empty()) return write_package(*files, folder).map([] { return std::string(); });
  std::string text;
  for (const PackageFile& file : *files) text += "==> " + file.path + " <==\n" + file.text + "\n";
  return text;
}

}  // namespace orbwatch::app
