/* A plugin's one argument, out=FILE, and the number that it writes there. */
#ifndef ORBWATCH_TESTS_BENCH_PLUGIN_OUTPUT_H
#define ORBWATCH_TESTS_BENCH_PLUGIN_OUTPUT_H

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <string.h>

/* The FILE; null, and a message, when the arguments are wrong. */
static const char* output_path(int argc, char** argv) {
  static const char kOut[] = "out=";
  if (argc == 1 && strncmp(argv[0], kOut, sizeof kOut - 1) == 0) return argv[0] + sizeof kOut - 1;
  fprintf(stderr, "plugin: takes one argument, out=FILE\n");
  return NULL;
}

static void write_number(const char* path, uint64_t number) {
  FILE* out = fopen(path, "w");
  if (!out || fprintf(out, "%" PRIu64 "\n", number) < 0 || fclose(out) != 0) {
    fprintf(stderr, "plugin: cannot write %s: %s\n", path, strerror(errno));
  }
}

#endif
