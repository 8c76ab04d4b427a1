// A shared library that has nothing to do with foam.
extern "C" int an_ordinary_function() {
    return 1;
}
