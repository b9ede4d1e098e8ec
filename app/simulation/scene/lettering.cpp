// SPDX-License-Identifier: Apache-2.0
#include "app/simulation/scene/lettering.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace orbwatch::app::simulation {
namespace {

constexpr int kRows = 7;
constexpr int kColumns = 5;
constexpr int kAdvance = 6;

struct Glyph {
  char letter;
  std::array<std::string_view, kRows> rows;
};

// Glyphs for the letters of the walls' names.
constexpr std::array kGlyphs{
    Glyph{'A', {".###.", "#...#", "#...#", "#####", "#...#", "#...#", "#...#"}},
    Glyph{'B', {"####.", "#...#", "#...#", "####.", "#...#", "#...#", "####."}},
    Glyph{'C', {".####", "#....", "#....", "#....", "#....", "#....", ".####"}},
    Glyph{'E', {"#####", "#....", "#....", "####.", "#....", "#....", "#####"}},
    Glyph{'F', {"#####", "#....", "#....", "####.", "#....", "#....", "#...."}},
    Glyph{'G', {".####", "#....", "#....", "#..##", "#...#", "#...#", ".####"}},
    Glyph{'H', {"#...#", "#...#", "#...#", "#####", "#...#", "#...#", "#...#"}},
    Glyph{'I', {".###.", "..#..", "..#..", "..#..", "..#..", "..#..", ".###."}},
    Glyph{'K', {"#...#", "#..#.", "#.#..", "##...", "#.#..", "#..#.", "#...#"}},
    Glyph{'L', {"#....", "#....", "#....", "#....", "#....", "#....", "#####"}},
    Glyph{'N', {"#...#", "##..#", "##..#", "#.#.#", "#..##", "#..##", "#...#"}},
    Glyph{'O', {".###.", "#...#", "#...#", "#...#", "#...#", "#...#", ".###."}},
    Glyph{'P', {"####.", "#...#", "#...#", "####.", "#....", "#....", "#...."}},
    Glyph{'R', {"####.", "#...#", "#...#", "####.", "#.#..", "#..#.", "#...#"}},
    Glyph{'T', {"#####", "..#..", "..#..", "..#..", "..#..", "..#..", "..#.."}},
};

}  // namespace

bool on_ink(std::string_view text, double height, double right, double up) {
  const double cell = height / kRows;
  const double line = static_cast<double>(text.size()) * kAdvance - (kAdvance - kColumns);
  const int column = static_cast<int>(std::floor(right / cell + line / 2));
  const int row = static_cast<int>(std::floor(kRows * 0.5 - up / cell));
  if (row < 0 || row >= kRows || column < 0 || column >= line) return false;
  const char letter = text[static_cast<std::size_t>(column / kAdvance)];
  const auto place = static_cast<std::size_t>(column % kAdvance);
  if (place >= kColumns) return false;
  for (const Glyph& glyph : kGlyphs) {
    if (glyph.letter == letter) return glyph.rows[static_cast<std::size_t>(row)][place] == '#';
  }
  return false;
}

}  // namespace orbwatch::app::simulation
