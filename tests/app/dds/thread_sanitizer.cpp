// Cyclone DDS and OpenCV's codecs come without instrumentation: what they synchronise by atomics
// looks like races inside them. Nothing of ours is synchronised by what they do.
extern "C" const char* __tsan_default_suppressions();
extern "C" const char* __tsan_default_suppressions() {
  return "called_from_lib:libddsc.so\n"
         "deadlock:libgdal.so\n";
}
