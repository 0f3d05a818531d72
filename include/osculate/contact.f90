! Contact of surfaces for codes in Fortran: a module over osculate/contact.h, which says what each
! function does. Compile it with the host, by the host's compiler, and link Osculate::contact.
!
!   status = osculate_evaluate(evaluator, x, size(x, kind=c_size_t), history, active_set, &
!                              c_null_ptr, c_null_ptr, result)
!   status = osculate_result_force(result, force)          ! real(c_double), pointer :: force(:)
!
! Handles are type(c_ptr); c_null_ptr stands for NULL. Numbers of nodes, facets and coordinates begin
! with 0 here, too. Names and texts are Fortran's own: no c_null_char is needed.
!
! size: one module, an interface for every function
module osculate_contact
  use, intrinsic :: iso_c_binding
  implicit none
  private :: to_c, from_c

  enum, bind(c)  ! osculate_status
    enumerator :: osculate_ok = 0, osculate_refused, osculate_too_small, osculate_no_memory, &
      osculate_defect
  end enum
  enum, bind(c)  ! osculate_facet_type
    enumerator :: osculate_line2 = 0, osculate_line3, osculate_line4, osculate_line5, &
      osculate_line6, osculate_line7, osculate_line8, osculate_tri3, osculate_tri6, &
      osculate_quad4, osculate_quad8, osculate_quad9
  end enum
  enum, bind(c)  ! osculate_friction_guess
    enumerator :: osculate_as_before = 0, osculate_sticking, osculate_sliding
  end enum
  enum, bind(c)  ! osculate_point_status
    enumerator :: osculate_open = 0, osculate_stick, osculate_slip
  end enum
  enum, bind(c)  ! osculate_feature
    enumerator :: osculate_no_feature = 0, osculate_face, osculate_edge, osculate_corner
  end enum
  enum, bind(c)  ! osculate_closest_status
    enumerator :: osculate_projected = 0, osculate_ambiguous, osculate_outside_domain, &
      osculate_invalid
  end enum
  enum, bind(c)  ! osculate_closest_mode
    enumerator :: osculate_nearest = 0, osculate_fast, osculate_certified
  end enum

  integer(c_int), parameter :: osculate_abi_of_module = 1  ! that of the library: osculate_abi()

  type, bind(c) :: osculate_multipliers
    type(c_ptr) :: values = c_null_ptr  ! real(c_double) (1 + dimension, points)
    integer(c_size_t) :: points = 0
    real(c_double) :: stiffening = 1, violation = 0
  end type
  type, bind(c) :: osculate_increment
    integer(c_int) :: tangent = 1, far_points = 0
    real(c_double) :: duration = 0, relief = 0
  end type
  type, bind(c) :: osculate_entry
    integer(c_int32_t) :: row, column
    real(c_double) :: value
  end type
  type, bind(c) :: osculate_coupling
    integer(c_int32_t) :: point, facet
  end type
  type, bind(c) :: osculate_block
    type(c_ptr) :: rows, columns, values
    integer(c_int32_t) :: row_count, column_count
  end type
  type, bind(c) :: osculate_csr
    type(c_ptr) :: row_start, columns, values, row_of, column_of
    integer(c_size_t) :: rows, row_count, column_count
    integer(c_int32_t) :: base = 1
  end type
  type, bind(c) :: osculate_contact_point
    integer(c_int32_t) :: status, feature, facet, edge
    real(c_double) :: xi(2), gap, normal_traction, shear_traction(3), slip(3), foot(3), normal(3)
    real(c_double) :: weight, stored, friction_work, damping_work
    integer(c_int32_t) :: outside_domain, reserved
  end type
  type, bind(c) :: osculate_constraints
    type(c_ptr) :: value, branch_value
    integer(c_size_t) :: count
    type(c_ptr) :: rows, columns, own
    integer(c_size_t) :: row_count, column_count, own_count
  end type
  type, bind(c) :: osculate_derivative_check
    real(c_double) :: error, order
    integer(c_int) :: exact, same_states, passed
  end type
  type, bind(c) :: osculate_closest_arrays
    type(c_ptr) :: status = c_null_ptr, feature = c_null_ptr, facet = c_null_ptr, &
      xi = c_null_ptr, foot = c_null_ptr, distance = c_null_ptr, margin = c_null_ptr, &
      unique = c_null_ptr
  end type
  type, bind(c) :: osculate_layer
    real(c_double) :: young = 0, poisson = 0, height = 0, area = 1
  end type

  ! ---- functions whose arguments are the same in both languages ---------------------------------

  interface
    integer(c_int) function osculate_abi() bind(c)
      import
    end function

    integer(c_int) function osculate_surface_create(dimension, out) bind(c)
      import
      integer(c_int), value :: dimension
      type(c_ptr), intent(out) :: out
    end function
    subroutine osculate_surface_free(surface) bind(c)
      import
      type(c_ptr), value :: surface
    end subroutine
    integer(c_int) function osculate_surface_add_facets(surface, type, nodes, count) bind(c)
      import
      type(c_ptr), value :: surface
      integer(c_int), value :: type
      integer(c_int32_t), intent(in) :: nodes(*)
      integer(c_size_t), value :: count
    end function
    integer(c_int) function osculate_surface_add_points(surface, nodes, count) bind(c)
      import
      type(c_ptr), value :: surface
      integer(c_int32_t), intent(in) :: nodes(*)
      integer(c_size_t), value :: count
    end function
    integer(c_int) function osculate_surface_set_frame(surface, nodes, count, closed) bind(c)
      import
      type(c_ptr), value :: surface
      integer(c_int32_t), intent(in) :: nodes(*)
      integer(c_size_t), value :: count
      integer(c_int), value :: closed
    end function

    integer(c_int) function osculate_contact_create(dimension, out) bind(c)
      import
      integer(c_int), value :: dimension
      type(c_ptr), intent(out) :: out
    end function
    subroutine osculate_contact_free(contact) bind(c)
      import
      type(c_ptr), value :: contact
    end subroutine
    integer(c_int) function osculate_contact_set_master(contact, master) bind(c)
      import
      type(c_ptr), value :: contact, master
    end function
    integer(c_int) function osculate_contact_set_slave(contact, slave) bind(c)
      import
      type(c_ptr), value :: contact, slave
    end function

    integer(c_int) function osculate_history_create(out) bind(c)
      import
      type(c_ptr), intent(out) :: out
    end function
    subroutine osculate_history_free(history) bind(c)
      import
      type(c_ptr), value :: history
    end subroutine
    integer(c_int) function osculate_history_copy(from, to) bind(c)
      import
      type(c_ptr), value :: from, to
    end function
    integer(c_int) function osculate_history_bytes(history, bytes, size) bind(c)
      import
      type(c_ptr), value :: history, bytes
      integer(c_size_t), intent(inout) :: size
    end function
    integer(c_int) function osculate_active_set_create(out) bind(c)
      import
      type(c_ptr), intent(out) :: out
    end function
    subroutine osculate_active_set_free(active_set) bind(c)
      import
      type(c_ptr), value :: active_set
    end subroutine
    integer(c_int) function osculate_active_set_copy(from, to) bind(c)
      import
      type(c_ptr), value :: from, to
    end function
    integer(c_int) function osculate_active_set_bytes(active_set, bytes, size) bind(c)
      import
      type(c_ptr), value :: active_set, bytes
      integer(c_size_t), intent(inout) :: size
    end function

    integer(c_int) function osculate_evaluator_create(contact, reference, size, out) bind(c)
      import
      type(c_ptr), value :: contact
      real(c_double), intent(in) :: reference(*)
      integer(c_size_t), value :: size
      type(c_ptr), intent(out) :: out
    end function
    subroutine osculate_evaluator_free(evaluator) bind(c)
      import
      type(c_ptr), value :: evaluator
    end subroutine
    integer(c_int) function osculate_initial_history(evaluator, coordinates, size, out) bind(c)
      import
      type(c_ptr), value :: evaluator, out
      real(c_double), intent(in) :: coordinates(*)
      integer(c_size_t), value :: size
    end function
    integer(c_int) function osculate_predicted(evaluator, committed, coordinates, size, guess, &
                                               out) bind(c)
      import
      type(c_ptr), value :: evaluator, committed, out
      real(c_double), intent(in) :: coordinates(*)
      integer(c_size_t), value :: size
      integer(c_int), value :: guess
    end function
    ! active_set, multipliers and increment: c_loc of them, or c_null_ptr
    integer(c_int) function osculate_evaluate(evaluator, coordinates, size, committed, active_set, &
                                              multipliers, increment, out) bind(c)
      import
      type(c_ptr), value :: evaluator, committed, active_set, multipliers, increment, out
      real(c_double), intent(in) :: coordinates(*)
      integer(c_size_t), value :: size
    end function
    integer(c_int) function osculate_slave_points(evaluator, points, terms, start, nodes, shape, &
                                                  facet) bind(c)
      import
      type(c_ptr), value :: evaluator, start, nodes, shape, facet
      integer(c_size_t), intent(inout) :: points, terms
    end function
    integer(c_int) function osculate_pattern_create(evaluator, coordinates, size, committed, &
                                                    motion, distance, out) bind(c)
      import
      type(c_ptr), value :: evaluator, committed
      real(c_double), intent(in) :: coordinates(*)
      integer(c_size_t), value :: size
      real(c_double), value :: motion, distance
      type(c_ptr), intent(out) :: out
    end function
    subroutine osculate_pattern_free(pattern) bind(c)
      import
      type(c_ptr), value :: pattern
    end subroutine
    integer(c_int) function osculate_pattern_couplings(pattern, couplings, count) bind(c)
      import
      type(c_ptr), value :: pattern
      type(c_ptr), intent(out) :: couplings
      integer(c_size_t), intent(out) :: count
    end function
    integer(c_int) function osculate_pattern_nodes(pattern, row_start, columns, nodes) bind(c)
      import
      type(c_ptr), value :: pattern
      type(c_ptr), intent(out) :: row_start, columns
      integer(c_size_t), intent(out) :: nodes
    end function
    integer(c_int) function osculate_pattern_points(pattern, start, nodes, points) bind(c)
      import
      type(c_ptr), value :: pattern
      type(c_ptr), intent(out) :: start, nodes
      integer(c_size_t), intent(out) :: points
    end function
    ! row_start and columns: c_loc of them, or c_null_ptr
    integer(c_int) function osculate_pattern_csr(pattern, row_of, row_count, column_of, &
                                                 column_count, rows, base, row_start, columns, &
                                                 size) bind(c)
      import
      type(c_ptr), value :: pattern, row_start, columns
      integer(c_size_t), value :: row_count, column_count, rows
      integer(c_int32_t), intent(in) :: row_of(*), column_of(*)
      integer(c_int32_t), value :: base
      integer(c_size_t), intent(inout) :: size
    end function
    integer(c_int) function osculate_pattern_csr64(pattern, row_of, row_count, column_of, &
                                                   column_count, rows, base, row_start, columns, &
                                                   size) bind(c)
      import
      type(c_ptr), value :: pattern, row_start, columns
      integer(c_size_t), value :: row_count, column_count, rows
      integer(c_int64_t), intent(in) :: row_of(*), column_of(*)
      integer(c_int32_t), value :: base
      integer(c_size_t), intent(inout) :: size
    end function
    integer(c_int) function osculate_read_history(evaluator, bytes, size, out) bind(c)
      import
      type(c_ptr), value :: evaluator, bytes, out
      integer(c_size_t), value :: size
    end function
    integer(c_int) function osculate_read_active_set(evaluator, bytes, size, out) bind(c)
      import
      type(c_ptr), value :: evaluator, bytes, out
      integer(c_size_t), value :: size
    end function
    integer(c_int) function osculate_initial_multipliers(evaluator, out) bind(c)
      import
      type(c_ptr), value :: evaluator
      type(osculate_multipliers), intent(inout) :: out
    end function
    integer(c_int) function osculate_unknowns_per_point(evaluator, out) bind(c)
      import
      type(c_ptr), value :: evaluator
      integer(c_int32_t), intent(out) :: out
    end function
    integer(c_int) function osculate_multipliers_of(evaluator, unknowns, size, out) bind(c)
      import
      type(c_ptr), value :: evaluator
      real(c_double), intent(in) :: unknowns(*)
      integer(c_size_t), value :: size
      type(osculate_multipliers), intent(inout) :: out
    end function
    integer(c_int) function osculate_unknowns_of(evaluator, multipliers, unknowns, size) bind(c)
      import
      type(c_ptr), value :: evaluator
      type(osculate_multipliers), intent(in) :: multipliers
      real(c_double), intent(out) :: unknowns(*)
      integer(c_size_t), value :: size
    end function

    integer(c_int) function osculate_result_create(out) bind(c)
      import
      type(c_ptr), intent(out) :: out
    end function
    subroutine osculate_result_free(result) bind(c)
      import
      type(c_ptr), value :: result
    end subroutine
    integer(c_int) function osculate_result_branched(result, out) bind(c)
      import
      type(c_ptr), value :: result
      integer(c_int), intent(out) :: out
    end function
    integer(c_int) function osculate_add_entries(entries, count, matrix) bind(c)
      import
      type(osculate_entry), intent(in) :: entries(*)
      integer(c_size_t), value :: count
      type(osculate_csr), intent(in) :: matrix
    end function
    integer(c_int) function osculate_add_entries64(entries, count, matrix) bind(c)
      import
      type(osculate_entry), intent(in) :: entries(*)
      integer(c_size_t), value :: count
      type(osculate_csr), intent(in) :: matrix  ! its arrays are integer(c_int64_t)
    end function
    integer(c_int) function osculate_result_constraints(result, out) bind(c)
      import
      type(c_ptr), value :: result
      type(osculate_constraints), intent(out) :: out
    end function
    integer(c_int) function osculate_result_next_active_set(result, out) bind(c)
      import
      type(c_ptr), value :: result, out
    end function
    integer(c_int) function osculate_result_multipliers(result, out) bind(c)
      import
      type(c_ptr), value :: result
      type(osculate_multipliers), intent(inout) :: out
    end function
    integer(c_int) function osculate_result_corrected_multipliers(result, out) bind(c)
      import
      type(c_ptr), value :: result
      type(osculate_multipliers), intent(inout) :: out
    end function
    integer(c_int) function osculate_result_committed(result, out) bind(c)
      import
      type(c_ptr), value :: result, out
    end function
    integer(c_int) function osculate_result_committed_multipliers(result, out) bind(c)
      import
      type(c_ptr), value :: result
      type(osculate_multipliers), intent(inout) :: out
    end function
    integer(c_int) function osculate_check_derivative(evaluator, coordinates, size, committed, &
        active_set, multipliers, increment, step, out) bind(c)
      import
      type(c_ptr), value :: evaluator, committed, active_set, multipliers, increment
      real(c_double), intent(in) :: coordinates(*)
      integer(c_size_t), value :: size
      real(c_double), value :: step
      type(osculate_derivative_check), intent(out) :: out
    end function

    integer(c_int) function osculate_closest_points_create(surface, coordinates, size, out) bind(c)
      import
      type(c_ptr), value :: surface
      real(c_double), intent(in) :: coordinates(*)
      integer(c_size_t), value :: size
      type(c_ptr), intent(out) :: out
    end function
    subroutine osculate_closest_points_free(closest) bind(c)
      import
      type(c_ptr), value :: closest
    end subroutine
    integer(c_int) function osculate_find_closest(closest, points, size, mode, threads, out) bind(c)
      import
      type(c_ptr), value :: closest
      real(c_double), intent(in) :: points(*)
      integer(c_size_t), value :: size
      integer(c_int), value :: mode, threads
      type(osculate_closest_arrays), intent(in) :: out
    end function

    integer(c_int) function osculate_automatic_penalties(slave, slave_count, master, master_count, &
        normal, shear) bind(c)
      import
      type(osculate_layer), intent(in) :: slave(*), master(*)
      integer(c_size_t), value :: slave_count, master_count
      real(c_double), intent(out) :: normal, shear
    end function
    real(c_double) function osculate_penalty_factor(ratio) bind(c)
      import
      real(c_double), value :: ratio
    end function
  end interface

contains

  ! ---- texts ------------------------------------------------------------------------------------

  function to_c(text) result(out)
    character(*), intent(in) :: text
    character(kind=c_char) :: out(len_trim(text) + 1)
    integer :: i
    do i = 1, len_trim(text)
      out(i) = text(i:i)
    end do
    out(len_trim(text) + 1) = c_null_char
  end function

  function from_c(address) result(text)
    type(c_ptr), intent(in) :: address
    character(:), allocatable :: text
    character(kind=c_char), pointer :: all(:)
    integer :: length, i
    interface
      integer(c_size_t) function c_strlen(text) bind(c, name='strlen')
        import
        type(c_ptr), value :: text
      end function
    end interface
    length = int(c_strlen(address))
    call c_f_pointer(address, all, [length])
    allocate (character(length) :: text)
    do i = 1, length
      text(i:i) = all(i)
    end do
  end function

  function osculate_error() result(text)
    character(:), allocatable :: text
    interface
      type(c_ptr) function c_error() bind(c, name='osculate_error')
        import
      end function
    end interface
    text = from_c(c_error())
  end function

  function osculate_version() result(text)
    character(:), allocatable :: text
    interface
      type(c_ptr) function c_version() bind(c, name='osculate_version')
        import
      end function
    end interface
    text = from_c(c_version())
  end function

  integer(c_int) function osculate_surface_add_shape(surface, shape) result(status)
    type(c_ptr), intent(in) :: surface
    character(*), intent(in) :: shape
    interface
      integer(c_int) function c_add_shape(surface, shape) &
          bind(c, name='osculate_surface_add_shape')
        import
        type(c_ptr), value :: surface
        character(kind=c_char), intent(in) :: shape(*)
      end function
    end interface
    status = c_add_shape(surface, to_c(shape))
  end function

  integer(c_int) function osculate_surface_set(surface, key, value) result(status)
    type(c_ptr), intent(in) :: surface
    character(*), intent(in) :: key
    real(c_double), intent(in) :: value
    status = osculate_surface_set_list(surface, key, [value])
  end function

  integer(c_int) function osculate_surface_set_list(surface, key, values) result(status)
    type(c_ptr), intent(in) :: surface
    character(*), intent(in) :: key
    real(c_double), intent(in) :: values(:)
    interface
      integer(c_int) function c_set_list(surface, key, values, count) &
          bind(c, name='osculate_surface_set_list')
        import
        type(c_ptr), value :: surface
        character(kind=c_char), intent(in) :: key(*)
        real(c_double), intent(in) :: values(*)
        integer(c_size_t), value :: count
      end function
    end interface
    status = c_set_list(surface, to_c(key), values, size(values, kind=c_size_t))
  end function

  integer(c_int) function osculate_contact_set(contact, key, value) result(status)
    type(c_ptr), intent(in) :: contact
    character(*), intent(in) :: key
    real(c_double), intent(in) :: value
    status = osculate_contact_set_list(contact, key, [value])
  end function

  integer(c_int) function osculate_contact_set_word(contact, key, word) result(status)
    type(c_ptr), intent(in) :: contact
    character(*), intent(in) :: key, word
    interface
      integer(c_int) function c_set_word(contact, key, word) &
          bind(c, name='osculate_contact_set_word')
        import
        type(c_ptr), value :: contact
        character(kind=c_char), intent(in) :: key(*), word(*)
      end function
    end interface
    status = c_set_word(contact, to_c(key), to_c(word))
  end function

  integer(c_int) function osculate_contact_set_list(contact, key, values) result(status)
    type(c_ptr), intent(in) :: contact
    character(*), intent(in) :: key
    real(c_double), intent(in) :: values(:)
    interface
      integer(c_int) function c_set_list(contact, key, values, count) &
          bind(c, name='osculate_contact_set_list')
        import
        type(c_ptr), value :: contact
        character(kind=c_char), intent(in) :: key(*)
        real(c_double), intent(in) :: values(*)
        integer(c_size_t), value :: count
      end function
    end interface
    status = c_set_list(contact, to_c(key), values, size(values, kind=c_size_t))
  end function

  ! ---- arrays of a result: pointers into it, good until it is evaluated into again -----------------

  integer(c_int) function osculate_result_force(result, force) result(status)
    type(c_ptr), intent(in) :: result
    real(c_double), pointer, intent(out) :: force(:)
    type(c_ptr) :: address
    integer(c_size_t) :: count
    interface
      integer(c_int) function c_force(result, force, size) bind(c, name='osculate_result_force')
        import
        type(c_ptr), value :: result
        type(c_ptr), intent(out) :: force
        integer(c_size_t), intent(out) :: size
      end function
    end interface
    nullify (force)
    status = c_force(result, address, count)
    if (status == osculate_ok) call c_f_pointer(address, force, [count])
  end function

  integer(c_int) function osculate_result_branch_force(result, force) result(status)
    type(c_ptr), intent(in) :: result
    real(c_double), pointer, intent(out) :: force(:)
    type(c_ptr) :: address
    integer(c_size_t) :: count
    interface
      integer(c_int) function c_force(result, force, size) &
          bind(c, name='osculate_result_branch_force')
        import
        type(c_ptr), value :: result
        type(c_ptr), intent(out) :: force
        integer(c_size_t), intent(out) :: size
      end function
    end interface
    nullify (force)
    status = c_force(result, address, count)
    if (status == osculate_ok) call c_f_pointer(address, force, [count])
  end function

  integer(c_int) function osculate_result_tangent(result, entries) result(status)
    type(c_ptr), intent(in) :: result
    type(osculate_entry), pointer, intent(out) :: entries(:)
    type(c_ptr) :: address
    integer(c_size_t) :: count
    interface
      integer(c_int) function c_tangent(result, entries, count) &
          bind(c, name='osculate_result_tangent')
        import
        type(c_ptr), value :: result
        type(c_ptr), intent(out) :: entries
        integer(c_size_t), intent(out) :: count
      end function
    end interface
    nullify (entries)
    status = c_tangent(result, address, count)
    if (status == osculate_ok) call c_f_pointer(address, entries, [count])
  end function

  integer(c_int) function osculate_result_blocks(result, blocks) result(status)
    type(c_ptr), intent(in) :: result
    type(osculate_block), pointer, intent(out) :: blocks(:)
    type(c_ptr) :: address
    integer(c_size_t) :: count
    interface
      integer(c_int) function c_blocks(result, blocks, count) bind(c, name='osculate_result_blocks')
        import
        type(c_ptr), value :: result
        type(c_ptr), intent(out) :: blocks
        integer(c_size_t), intent(out) :: count
      end function
    end interface
    nullify (blocks)
    status = c_blocks(result, address, count)
    if (status == osculate_ok) call c_f_pointer(address, blocks, [count])
  end function

  integer(c_int) function osculate_result_points(result, points) result(status)
    type(c_ptr), intent(in) :: result
    type(osculate_contact_point), allocatable, target, intent(out) :: points(:)
    integer(c_size_t) :: count
    interface
      integer(c_int) function c_points(result, points, count) bind(c, name='osculate_result_points')
        import
        type(c_ptr), value :: result, points
        integer(c_size_t), intent(inout) :: count
      end function
    end interface
    count = 0
    status = c_points(result, c_null_ptr, count)
    if (status /= osculate_ok) return
    allocate (points(count))
    if (count > 0) status = c_points(result, c_loc(points), count)
  end function

end module osculate_contact
