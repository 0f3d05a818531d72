! Places of a tangent in Fortran: the same with numbers of 32 and of 64 bits, and room for all entries.
program pattern
  use osculate_contact
  implicit none
  integer, parameter :: nodes = 7, unknowns = 2 * nodes
  real(c_double) :: x(2, nodes)
  type(c_ptr) :: evaluator, history, evaluation, places
  integer(c_int32_t), target :: start(unknowns + 1)
  integer(c_int32_t), allocatable, target :: columns(:)
  integer(c_int64_t), target :: start64(unknowns + 1), number64(unknowns)
  integer(c_int64_t), allocatable, target :: columns64(:)
  real(c_double), allocatable, target :: values(:)
  integer(c_int32_t) :: number(unknowns)
  integer(c_size_t) :: needed, needed64
  type(osculate_entry), pointer :: tangent(:)
  type(osculate_csr) :: matrix
  integer :: i

  ! Two lines of the master with the body below, and one of the slave a little inside.
  x = reshape([0.0_c_double, 0.0_c_double, 2.0_c_double, 0.0_c_double, 4.0_c_double, 0.0_c_double, &
               6.0_c_double, 0.0_c_double, 8.0_c_double, 0.0_c_double, &
               3.0_c_double, -0.1_c_double, 1.0_c_double, -0.1_c_double], [2, nodes])
  evaluator = touch()
  call check(osculate_history_create(history))
  call check(osculate_result_create(evaluation))
  call check(osculate_initial_history(evaluator, x, size(x, kind=c_size_t), history))
  call check(osculate_pattern_create(evaluator, x, size(x, kind=c_size_t), history, 0.1_c_double, &
                                     0.5_c_double, places))
  number = [(i, i=1, unknowns)]
  number(1:2) = 0  ! below the base: left out
  number64 = number
  needed = 0
  call check(osculate_pattern_csr(places, number, size(number, kind=c_size_t), number, &
                                  size(number, kind=c_size_t), int(unknowns, c_size_t), 1, &
                                  c_loc(start), c_null_ptr, needed))
  needed64 = 0
  call check(osculate_pattern_csr64(places, number64, size(number64, kind=c_size_t), number64, &
                                    size(number64, kind=c_size_t), int(unknowns, c_size_t), 1, &
                                    c_loc(start64), c_null_ptr, needed64))
  if (needed == 0 .or. needed64 /= needed) error stop 'sizes'
  allocate (columns(needed), columns64(needed), values(needed))
  call check(osculate_pattern_csr(places, number, size(number, kind=c_size_t), number, &
                                  size(number, kind=c_size_t), int(unknowns, c_size_t), 1, &
                                  c_null_ptr, c_loc(columns), needed))
  call check(osculate_pattern_csr64(places, number64, size(number64, kind=c_size_t), number64, &
                                    size(number64, kind=c_size_t), int(unknowns, c_size_t), 1, &
                                    c_null_ptr, c_loc(columns64), needed64))
  if (any(start64 /= start) .or. any(columns64 /= columns)) error stop 'other places'
  if (start64(unknowns + 1) /= needed + 1 .or. start64(1) /= 1 .or. start64(3) /= 1) error stop 'rows'

  call check(osculate_evaluate(evaluator, x, size(x, kind=c_size_t), history, c_null_ptr, &
                               c_null_ptr, c_null_ptr, evaluation))
  call check(osculate_result_tangent(evaluation, tangent))
  values = 0
  matrix = osculate_csr(c_loc(start64), c_loc(columns64), c_loc(values), c_loc(number64), &
                        c_loc(number64), unknowns, unknowns, unknowns, 1)
  call check(osculate_add_entries64(tangent, size(tangent, kind=c_size_t), matrix))
  if (sum(abs(values)) < 1) error stop 'no stiffness'
  do i = 1, size(tangent)
    associate (row => tangent(i)%row + 1, column => tangent(i)%column + 1)
      if (row > 2 .and. column > 2) call take(row, column, tangent(i)%value)
    end associate
  end do
  if (maxval(abs(values)) > 1e-10_c_double) error stop 'another matrix'
  print '(a, i0)', 'places: ', needed64
  call osculate_pattern_free(places)
  call osculate_result_free(evaluation)
  call osculate_history_free(history)
  call osculate_evaluator_free(evaluator)

contains

  subroutine check(status)
    integer(c_int), intent(in) :: status
    if (status == osculate_ok) return
    print '(a)', osculate_error()
    error stop 2
  end subroutine

  function touch() result(out)
    type(c_ptr) :: out, master, slave, description
    call check(osculate_surface_create(2, master))
    call check(osculate_surface_add_facets(master, osculate_line2, [0, 1, 1, 2, 2, 3, 3, 4], &
                                           8_c_size_t))
    call check(osculate_surface_create(2, slave))
    call check(osculate_surface_add_facets(slave, osculate_line2, [5, 6], 2_c_size_t))
    call check(osculate_contact_create(2, description))
    call check(osculate_contact_set_master(description, master))
    call check(osculate_contact_set_slave(description, slave))
    call check(osculate_contact_set(description, 'normal.penalty', 100.0_c_double))
    call check(osculate_evaluator_create(description, x, size(x, kind=c_size_t), out))
    call osculate_contact_free(description)
    call osculate_surface_free(master)
    call osculate_surface_free(slave)
  end function

  ! Takes a value from its place in the matrix.
  subroutine take(row, column, value)
    integer(c_int32_t), intent(in) :: row, column
    real(c_double), intent(in) :: value
    integer(c_int64_t) :: k
    do k = start64(row), start64(row + 1) - 1
      if (columns64(k) /= column) cycle
      values(k) = values(k) - value
      return
    end do
    error stop 'no place'
  end subroutine

end program pattern
