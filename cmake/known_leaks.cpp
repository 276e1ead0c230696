// Linked into every executable that is built with the address sanitizer (cmake/Options.cmake): what other libraries
// keep until the process ends, which a check for leaks must not take for ours. CLN keeps 26 bytes of its constants,
// Fontconfig some of its patterns, CGAL the analyses of curves that refer to one another.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libcln\nleak:libfontconfig\nleak:CGAL::\n"; }

// And no word about them on standard error, which is the program's own.
extern "C" const char* __lsan_default_options();
extern "C" const char* __lsan_default_options() { return "print_suppressions=0"; }
