! A host of Osculate::contact in Fortran: a small finite-element code for plane strain, whose block of
! linear quadrilaterals is pressed onto a rigid drum and dragged. It has its mesh, its matrix and its
! Newton method; the library gives forces and tangent of contact.
!
!   osculate run pressed_block.yaml -o results     the same model with the bodies of Osculate
!   host results/history.csv                       compares the forces on the block
module block
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t
  implicit none
  integer, parameter :: columns = 16, rows = 4, nodes = (columns + 1) * (rows + 1)
  integer, parameter :: frame = 3, all_nodes = frame + nodes, unknowns = 2 * all_nodes
  real(c_double), parameter :: width = 2, height = 1, young = 1000, poisson = 0.3_c_double

contains

  ! The first three nodes carry the drum; those of the block stand behind them, row by row.
  integer function node(column, row)
    integer, intent(in) :: column, row
    node = frame + row * (columns + 1) + column + 1
  end function

  function reference() result(x)
    real(c_double) :: x(2, all_nodes)
    integer :: i, j
    x(:, 1:3) = reshape([0, 0, 1, 0, 0, 1], [2, 3])
    do j = 0, rows
      do i = 0, columns
        x(:, node(i, j)) = [width * (i / real(columns, c_double) - 0.5_c_double), &
                            height * j / real(rows, c_double)]
      end do
    end do
  end function

  ! The side of the block that touches: lines of two nodes with the body on their right, nodes
  ! counted from 0.
  function bottom() result(lines)
    integer(c_int32_t) :: lines(2 * columns)
    integer :: i
    do i = 1, columns
      lines(2 * i - 1:2 * i) = [node(i, 0) - 1, node(i - 1, 0) - 1]
    end do
  end function

  ! Stiffness of one cell, a rectangle of hx times hy, with 2 x 2 Gauss points.
  function cell_stiffness(hx, hy) result(k)
    real(c_double), intent(in) :: hx, hy
    real(c_double) :: k(8, 8), d(3, 3), b(3, 8), xi(4), eta(4), at
    integer :: p, q, n
    xi = [-1, 1, 1, -1]
    eta = [-1, -1, 1, 1]
    at = 1 / sqrt(3.0_c_double)
    d = 0
    d(1:2, 1:2) = poisson
    d(1, 1) = 1 - poisson
    d(2, 2) = 1 - poisson
    d(3, 3) = (1 - 2 * poisson) / 2
    d = d * young / ((1 + poisson) * (1 - 2 * poisson))
    k = 0
    do p = -1, 1, 2
      do q = -1, 1, 2
        b = 0
        do n = 1, 4
          b(1, 2 * n - 1) = xi(n) * (1 + eta(n) * q * at) / (2 * hx)
          b(2, 2 * n) = eta(n) * (1 + xi(n) * p * at) / (2 * hy)
          b(3, 2 * n - 1) = b(2, 2 * n)
          b(3, 2 * n) = b(1, 2 * n - 1)
        end do
        k = k + matmul(transpose(b), matmul(d, b)) * hx * hy / 4
      end do
    end do
  end function

  function stiffness() result(k)
    real(c_double) :: k(unknowns, unknowns), cell(8, 8)
    integer :: i, j, at(8), corners(4)
    cell = cell_stiffness(width / columns, height / rows)
    k = 0
    do j = 0, rows - 1
      do i = 0, columns - 1
        corners = [node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)]
        at(1::2) = 2 * corners - 1
        at(2::2) = 2 * corners
        k(at, at) = k(at, at) + cell
      end do
    end do
  end function

  ! Where the host prescribes displacements: the drum's frame and the top of the block.
  function held() result(is)
    logical :: is(unknowns)
    integer :: i
    is = .false.
    is(1:2 * frame) = .true.
    do i = 0, columns
      is(2 * node(i, rows) - 1:2 * node(i, rows)) = .true.
    end do
  end function

  ! a x = b by elimination with pivots; both are overwritten, x comes back in b.
  subroutine solve(a, b)
    real(c_double), intent(inout) :: a(:, :), b(:)
    real(c_double) :: line(size(b)), kept
    integer :: k, i, pivot
    do k = 1, size(b)
      pivot = k - 1 + maxloc(abs(a(k:, k)), 1)
      line = a(k, :)
      a(k, :) = a(pivot, :)
      a(pivot, :) = line
      kept = b(k)
      b(k) = b(pivot)
      b(pivot) = kept
      do i = k + 1, size(b)
        b(i) = b(i) - a(i, k) / a(k, k) * b(k)
        a(i, k:) = a(i, k:) - a(i, k) / a(k, k) * a(k, k:)
      end do
    end do
    do k = size(b), 1, -1
      b(k) = (b(k) - dot_product(a(k, k + 1:), b(k + 1:))) / a(k, k)
    end do
  end subroutine

end module block

program host
  use osculate_contact
  use block
  implicit none
  real(c_double) :: x0(2, all_nodes), u(unknowns), k(unknowns, unknowns), force(2)
  type(c_ptr) :: contact, history, active_set, evaluation
  integer :: increment

  if (osculate_abi() /= osculate_abi_of_module) error stop 'another library than the module is of'
  x0 = reference()
  u = 0
  k = stiffness()
  contact = touch()
  call check(osculate_history_create(history))
  call check(osculate_active_set_create(active_set))
  call check(osculate_result_create(evaluation))
  call check(osculate_initial_history(contact, x0, size(x0, kind=c_size_t), history))
  do increment = 1, 6
    if (increment <= 2) call move(0.0_c_double, -0.025_c_double)
    if (increment > 2) call move(0.02_c_double, 0.0_c_double)
    call check(osculate_result_committed(evaluation, history))
    force = force_on_block()
    print '(a, i0, 2(a, f0.9))', 'increment ', increment, ': force_x ', force(1), ', force_y ', &
      force(2)
    call compare(increment, force)
  end do
  call osculate_result_free(evaluation)
  call osculate_active_set_free(active_set)
  call osculate_history_free(history)
  call osculate_evaluator_free(contact)

contains

  subroutine check(status)
    integer(c_int), intent(in) :: status
    if (status == osculate_ok) return
    print '(a)', osculate_error()
    error stop 2
  end subroutine

  ! The contact of the block's bottom with the drum, a circle on a frame of three nodes.
  function touch() result(evaluator)
    type(c_ptr) :: evaluator, drum, side, description
    integer(c_int32_t) :: lines(2 * columns)
    call check(osculate_surface_create(2, drum))
    call check(osculate_surface_add_shape(drum, 'circle'))
    call check(osculate_surface_set_list(drum, 'center', [0.0_c_double, -5.0_c_double]))
    call check(osculate_surface_set(drum, 'radius', 5.0_c_double))
    call check(osculate_surface_set_frame(drum, [0, 1, 2], 3_c_size_t, 0))
    call check(osculate_surface_create(2, side))
    lines = bottom()
    call check(osculate_surface_add_facets(side, osculate_line2, lines, size(lines, kind=c_size_t)))
    call check(osculate_contact_create(2, description))
    call check(osculate_contact_set_master(description, drum))
    call check(osculate_contact_set_slave(description, side))
    call check(osculate_contact_set(description, 'normal.penalty', 3.0e4_c_double))
    call check(osculate_contact_set(description, 'friction.coulomb.mu', 0.3_c_double))
    call check(osculate_contact_set(description, 'friction.coulomb.penalty', 1.0e4_c_double))
    call check(osculate_evaluator_create(description, x0, size(x0, kind=c_size_t), evaluator))
    call osculate_contact_free(description)
    call osculate_surface_free(drum)
    call osculate_surface_free(side)
  end function

  ! Forces, matrix and right-hand side at the present displacements. The forces decide whether they
  ! are the solution; those that the tangent belongs to are what a correction is computed from.
  subroutine assemble(matrix, residual, correct_from)
    real(c_double), intent(out) :: matrix(:, :), residual(:), correct_from(:)
    real(c_double), pointer :: of_contact(:), of_branches(:)
    type(osculate_entry), pointer :: tangent(:)
    real(c_double) :: x(2, all_nodes)
    integer :: i
    x = x0 + reshape(u, shape(x0))
    call check(osculate_evaluate(contact, x, size(x, kind=c_size_t), history, active_set, &
                                 c_null_ptr, c_null_ptr, evaluation))
    call check(osculate_result_force(evaluation, of_contact))
    call check(osculate_result_branch_force(evaluation, of_branches))
    call check(osculate_result_tangent(evaluation, tangent))
    residual = matmul(k, u)
    correct_from = residual + of_branches
    residual = residual + of_contact
    matrix = k
    do i = 1, size(tangent)
      associate (row => tangent(i)%row + 1, column => tangent(i)%column + 1)
        matrix(row, column) = matrix(row, column) + tangent(i)%value
      end associate
    end do
  end subroutine

  ! One increment: the top of the block moves on. The first correction comes from where the
  ! increment begins, and the motion enters through the tangent.
  subroutine move(right, up)
    real(c_double), intent(in) :: right, up
    real(c_double), save :: matrix(unknowns, unknowns)  ! too large for a stack
    real(c_double) :: residual(unknowns), correction(unknowns)
    logical :: is_held(unknowns)
    real(c_double) :: x(2, all_nodes), step(unknowns)
    integer :: iteration, i
    is_held = held()
    step = 0
    do i = 0, columns
      step(2 * node(i, rows) - 1:2 * node(i, rows)) = [right, up]
    end do
    x = x0 + reshape(u, shape(x0))
    call check(osculate_predicted(contact, history, x, size(x, kind=c_size_t), &
                                  osculate_as_before, active_set))
    do iteration = 1, 30
      call assemble(matrix, residual, correction)
      if (iteration > 1 .and. norm2(pack(residual, .not. is_held)) < 1e-10_c_double) return
      correction = -correction
      call hold(matrix, correction, is_held, step)
      call solve(matrix, correction)
      u = u + correction
      step = 0
      call check(osculate_result_next_active_set(evaluation, active_set))
    end do
    error stop 'no convergence'
  end subroutine

  ! Rows and columns of what is held become those of the unit matrix.
  subroutine hold(matrix, right_hand_side, is_held, value)
    real(c_double), intent(inout) :: matrix(:, :), right_hand_side(:)
    logical, intent(in) :: is_held(:)
    real(c_double), intent(in) :: value(:)
    integer :: i
    do i = 1, unknowns
      if (is_held(i)) right_hand_side = right_hand_side - matrix(:, i) * value(i)
    end do
    do i = 1, unknowns
      if (.not. is_held(i)) cycle
      matrix(:, i) = 0
      matrix(i, :) = 0
      matrix(i, i) = 1
      right_hand_side(i) = value(i)
    end do
  end subroutine

  ! The forces of the result are internal ones: the drum acts on the block with their negative.
  function force_on_block() result(sum_of_nodes)
    real(c_double) :: sum_of_nodes(2)
    real(c_double), pointer :: of_contact(:)
    call check(osculate_result_force(evaluation, of_contact))
    sum_of_nodes = -sum(reshape(of_contact(2 * frame + 1:), [2, nodes]), 2)
  end function

  ! With the row of the increment in history.csv, if one is named: time, force_x, force_y.
  subroutine compare(row, ours)
    integer, intent(in) :: row
    real(c_double), intent(in) :: ours(2)
    real(c_double) :: time, theirs(2)
    integer :: unit, i, step, number
    character(500) :: path, line
    call get_command_argument(1, path)
    if (path == '') return
    open (newunit=unit, file=trim(path), status='old', action='read')
    read (unit, '(a)') line
    if (index(line, 'step,increment,time,touch.force_x,touch.force_y') /= 1) error stop 'columns'
    do i = 0, row  ! from the state before the first increment
      read (unit, *) step, number, time, theirs
    end do
    close (unit)
    if (.not. norm2(ours - theirs) <= 1e-9_c_double * norm2(theirs)) then
      print '(a, 2f20.12)', 'osculate run has ', theirs
      error stop 1
    end if
  end subroutine

end program host
