// SPDX-License-Identifier: Apache-2.0
#include "app/cli/doctor/board.h"

#include <algorithm>
#include <utility>

#include "app/files/text/text_file.h"
#include "app/files/toml/toml_reader.h"
#include "app/health/system_file.h"

namespace orbwatch::app::cli::doctor {
namespace {

namespace fs = std::filesystem;

/// Keys of a file: a board's, and the board that it is based on.
struct BoardFile {
  std::string like;
  Board board;
};

template <class Visitor>
void visit(Visitor& v, BoardFile& file) {
  v.optional("like", file.like, "Another file of this folder, without its ending");
  visit(v, file.board);
}

/// Reads a file over the contents of `file`. Lists of tables are appended.
Result<> read_over(const fs::path& path, BoardFile& file) {
  files::TextFiles files;
  const auto text = files.read(path, "a TOML file");
  if (!text) return tl::unexpected(text.error());
  files::Finding finding{.file = path.string(), .folder = path.parent_path()};
  read_toml(*text, file, finding);
  if (finding.message) return fail(*finding.message);
  return {};
}

bool is_plain_name(std::string_view name) {
  return !name.empty() && name.find('/') == std::string_view::npos && !name.starts_with('.');
}

}  // namespace

Result<Board> read_board(const fs::path& file) {
  BoardFile own;
  if (auto read = read_over(file, own); !read) return tl::unexpected(read.error());
  if (own.like.empty()) return own.board;
  if (!is_plain_name(own.like)) return fail(file.string() + ": like: must be the name of a board");
  const fs::path base = file.parent_path() / (own.like + ".toml");
  BoardFile both;
  if (auto read = read_over(base, both); !read) return tl::unexpected(read.error());
  if (!both.like.empty()) {
    return fail(file.string() + ": like: " + own.like + " is itself like another board");
  }
  if (auto read = read_over(file, both); !read) return tl::unexpected(read.error());
  return both.board;
}

std::vector<Board> read_boards(const fs::path& folder, std::vector<std::string>& problems) {
  std::vector<fs::path> files = entries(folder);
  std::error_code unknown;
  std::erase_if(files, [&unknown](const fs::path& file) {
    return file.extension() != ".toml" || !fs::is_regular_file(file, unknown);
  });
  std::ranges::sort(files);
  std::vector<Board> boards;
  for (const fs::path& file : files) {
    auto board = read_board(file);
    if (board) {
      boards.push_back(std::move(*board));
    } else {
      problems.push_back(board.error().message);
    }
  }
  return boards;
}

const Board* find_board(const std::vector<Board>& boards, std::string_view model,
                        std::string_view architecture) {
  const Board* best = nullptr;
  std::size_t length = 0;
  for (const Board& board : boards) {
    for (const std::string& beginning : board.models) {
      if (beginning.size() <= length || !model.starts_with(beginning)) continue;
      best = &board;
      length = beginning.size();
    }
  }
  if (best != nullptr) return best;
  const auto any = std::ranges::find_if(boards, [architecture](const Board& board) {
    return !architecture.empty() && board.architecture == architecture;
  });
  return any == boards.end() ? nullptr : &*any;
}

const BoardLines* find_lines(const Board& board, std::string_view name) {
  const auto found = std::ranges::find_if(board.lines, [name](const BoardLines& lines) {
    return std::ranges::find(lines.names, name) != lines.names.end();
  });
  return found == board.lines.end() ? nullptr : &*found;
}

const BoardCamera* find_camera(const Board& board, std::string_view wanted) {
  const auto found = std::ranges::find_if(board.cameras, [wanted](const BoardCamera& camera) {
    return wanted.find(camera.sensor) != std::string_view::npos;
  });
  return found == board.cameras.end() ? nullptr : &*found;
}

}  // namespace orbwatch::app::cli::doctor
