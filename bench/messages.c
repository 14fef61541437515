/* Counts what each rank sends: messages and bytes between two processes, and collective calls.

     mpicc -shared -fPIC bench/messages.c -o messages.so
     mpirun -np 2 -x LD_PRELOAD=$PWD/messages.so build/lmp -in in.script

   At the end each rank prints a line. Take differences of two runs for what a step costs; bench/bound.py --messages does. */

#include <mpi.h>
#include <stdio.h>

static long messages, bytes, collectives;

static void count(int n, MPI_Datatype type)
{
  int size;
  MPI_Type_size(type, &size);
  ++messages;
  bytes += (long) n * size;
}

int MPI_Send(const void *buf, int n, MPI_Datatype type, int to, int tag, MPI_Comm comm)
{
  count(n, type);
  return PMPI_Send(buf, n, type, to, tag, comm);
}

int MPI_Isend(const void *buf, int n, MPI_Datatype type, int to, int tag, MPI_Comm comm, MPI_Request *request)
{
  count(n, type);
  return PMPI_Isend(buf, n, type, to, tag, comm, request);
}

int MPI_Allreduce(const void *mine, void *all, int n, MPI_Datatype type, MPI_Op op, MPI_Comm comm)
{
  ++collectives;
  return PMPI_Allreduce(mine, all, n, type, op, comm);
}

int MPI_Finalize(void)
{
  int rank;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  printf("rank %d sent %ld messages, %ld bytes, took part in %ld sums\n", rank, messages, bytes, collectives);
  return PMPI_Finalize();
}
