// SPDX-License-Identifier: Apache-2.0
/* A plugin's one argument, out=FILE, and the line of numbers that it writes there. */
#ifndef ORBWATCH_TESTS_BENCH_PLUGIN_OUTPUT_H
#define ORBWATCH_TESTS_BENCH_PLUGIN_OUTPUT_H

#include <errno.h>
#include <inttypes.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

/* The FILE; null, and a message, when the arguments are wrong. */
static const char* output_path(int argc, char** argv) {
  static const char kOut[] = "out=";
  if (argc == 1 && strncmp(argv[0], kOut, sizeof kOut - 1) == 0) return argv[0] + sizeof kOut - 1;
  fprintf(stderr, "plugin: takes one argument, out=FILE\n");
  return NULL;
}

/* `first`, then `count` more. */
static inline void write_numbers(const char* path, uint64_t first, const uint64_t* more,
                                 int count) {
  FILE* out = fopen(path, "w");
  bool is_written = out && fprintf(out, "%" PRIu64, first) > 0;
  for (int i = 0; i < count && is_written; ++i) {
    is_written = fprintf(out, " %" PRIu64, more[i]) > 0;
  }
  if (!is_written || fputc('\n', out) == EOF || fclose(out) != 0) {
    fprintf(stderr, "plugin: cannot write %s: %s\n", path, strerror(errno));
  }
}

static inline void write_number(const char* path, uint64_t number) {
  write_numbers(path, number, NULL, 0);
}

#endif
