// For programs with sanitizers: modules of Open MPI stay in memory until the end, so that leaks in them can be
// told by name (leaks_of_others.txt) from those of the package.

extern "C" int dlclose(void *)
{
  return 0;
}
