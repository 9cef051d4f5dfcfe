message(FATAL_ERROR "Node or npm is missing, so the page was not built: run tools/setup.sh (nodejs, npm, chromium) and "
  "configure again, or configure with -DLEKALO_WITH_PAGE=OFF")
