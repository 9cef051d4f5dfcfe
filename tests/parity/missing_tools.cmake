message(FATAL_ERROR "lekalo.wasm was not built, or Node is missing: run tools/setup.sh and configure again "
  "(clang-19, lld-19, wasi-libc, libc++-19-dev-wasm32, libclang-rt-19-dev-wasm32, nodejs)")
