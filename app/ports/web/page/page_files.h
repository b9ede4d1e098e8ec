#pragma once

#include <span>
#include <string_view>

namespace orbwatch::app::web {

/// A file of page/files, as the build found it.
struct PageFile {
  std::string_view name;  ///< its path there
  std::string_view content;
};

/// The page: index.html and what it loads.
extern const std::span<const PageFile> kPageFiles;

/// Of its name's ending; empty for one that the page has none of.
std::string_view page_type(std::string_view name);

}  // namespace orbwatch::app::web
