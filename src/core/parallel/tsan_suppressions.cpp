// Suppressions of the thread sanitizer, built into every program of a thread-sanitizer build. They concern libraries
// that are not instrumented, so that the sanitizer cannot see how they synchronise their threads:
//  - libtbb passes memory that it allocates between its threads. Our code inside TBB tasks is still checked.
//  - liblcm's memq:// passes a message from publisher to receiver under GLib's locks, which are bare futexes. LcmBus
//    declares this order for our handlers, but liblcm compares the message's channel before it calls them.
//  - libOpenNI2 and its file driver libOniFile call drivers, and are called by them, holding their own locks in either
//    order; they pass memory between their threads, and at the end of the program unlock mutexes that they have not
//    locked. A report with one of their functions anywhere on its stack is suppressed.
//  - FFmpeg's encoders, and umockdev with libudev and GLib, pass memory between their own threads.
extern "C" const char* __tsan_default_suppressions() {
  return "called_from_lib:libtbb.so\n"
         "race:g_str_equal\n"
         "mutex:libOpenNI2.so\n"
         "deadlock:libOpenNI2.so\n"
         "race:libOpenNI2.so\n"
         "race:libOniFile.so\n"
         "race:libavutil.so\n"
         "race:libavcodec.so\n"
         "race:libumockdev.so\n"
         "race:libudev.so\n";
}
