// Built into every program of a thread-sanitizer build. Memory that libtbb itself allocates and frees is handed between
// its threads by means the sanitizer cannot see; what our code does inside TBB tasks is not covered by this.
extern "C" const char* __tsan_default_suppressions() { return "called_from_lib:libtbb.so\n"; }
