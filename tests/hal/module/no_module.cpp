/// A shared object that has nothing to do with cameras.
extern "C" int orbwatch_something_else() { return 0; }
