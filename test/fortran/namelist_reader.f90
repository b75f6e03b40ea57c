! Reads the files 1.nml, 2.nml, ... of a folder as namelist input, with the Fortran runtime itself, and prints what it got from
! each group: the status of the read (0, -1 not found or not ended, 1 refused) and the bits of every value. The other side of
! namelist_differential.cpp. Lengths and sizes are those of the key registry.
program namelist_reader
  use, intrinsic :: iso_fortran_env, only: int32, int64, real64
  implicit none
  integer(int64), parameter :: unset_bits = int(z'7FF8DEADBEEF0001', int64)
  integer, parameter :: unit_in = 10
  real(real64) :: unset, infinity
  character(len=4096) :: folder, word
  integer :: i, count

  unset = transfer(unset_bits, unset)
  infinity = transfer(int(z'7FF0000000000000', int64), infinity)
  call get_command_argument(1, folder)
  call get_command_argument(2, word)
  read (word, *) count
  do i = 1, count
    write (word, '(a,"/",i0,".nml")') trim(folder), i
    open (unit_in, file=trim(word), status='old', action='read')
    print '(a,1x,i0)', 'case', i
    call read_run()
    call read_solids()
    call read_surface()
    call read_asperities()
    call read_indentation()
    call read_solver()
    call read_elements()
    call read_compare()
    call read_output()
    close (unit_in)
  end do

contains

  subroutine status(group, ios)
    character(len=*), intent(in) :: group
    integer, intent(in) :: ios
    print '(a,1x,i0)', 'status '//group, sign(min(abs(ios), 1), ios)
    rewind (unit_in)
  end subroutine

  subroutine put_real(name, x, element)
    character(len=*), intent(in) :: name
    real(real64), intent(in) :: x
    integer, intent(in), optional :: element
    character(len=16) :: value, index
    index = ''
    if (present(element)) write (index, '("(",i0,")")') element
    if (transfer(x, unset_bits) == unset_bits) then
      value = 'unset'
    else if (x /= x) then
      value = 'nan'
    else
      write (value, '(z16.16)') transfer(x, unset_bits)
    end if
    print '(a)', name//trim(index)//' '//trim(value)
  end subroutine

  subroutine put_list(name, x)
    character(len=*), intent(in) :: name
    real(real64), intent(in) :: x(:)
    integer :: k, last
    last = 0
    do k = 1, size(x)
      if (transfer(x(k), unset_bits) /= unset_bits) last = k
    end do
    do k = 1, last
      call put_real(name, x(k), k)
    end do
  end subroutine

  subroutine put_integer(name, n)
    character(len=*), intent(in) :: name
    integer(int64), intent(in) :: n
    print '(a,1x,i0)', name, n
  end subroutine

  subroutine put_logical(name, value)
    character(len=*), intent(in) :: name
    logical, intent(in) :: value
    print '(a,1x,l1)', name, value
  end subroutine

  subroutine put_text(name, text)
    character(len=*), intent(in) :: name, text
    integer :: k
    write (*, '(a)', advance='no') name//' '
    do k = 1, len_trim(text)
      write (*, '(z2.2)', advance='no') iachar(text(k:k))
    end do
    print '(a)', '.'
  end subroutine

  subroutine read_run()
    character(len=1024) :: title
    integer(int64) :: seed
    integer(int32) :: realizations, first_realization, threads
    character(len=64) :: length_unit, force_unit
    integer :: ios
    namelist /run/ title, seed, realizations, first_realization, threads, length_unit, force_unit
    title = ''
    seed = 1
    realizations = 1
    first_realization = 1
    threads = 0
    length_unit = 'mm'
    force_unit = 'N'
    read (unit_in, nml=run, iostat=ios)
    call status('run', ios)
    call put_text('run%title', title)
    call put_integer('run%seed', seed)
    call put_integer('run%realizations', int(realizations, int64))
    call put_integer('run%first_realization', int(first_realization, int64))
    call put_integer('run%threads', int(threads, int64))
    call put_text('run%length_unit', length_unit)
    call put_text('run%force_unit', force_unit)
  end subroutine

  subroutine read_solids()
    real(real64) :: e(2), nu(2), r(2), resistivity(2), friction, hardness, size_effect
    integer :: ios, k
    namelist /solids/ e, nu, r, hardness, size_effect, resistivity, friction
    e = [78.0e3_real64, infinity]
    nu = [0.42_real64, 0.0_real64]
    r = [infinity, 2.5_real64]
    resistivity = 0
    friction = 0
    hardness = infinity
    size_effect = 0
    read (unit_in, nml=solids, iostat=ios)
    call status('solids', ios)
    do k = 1, 2
      call put_real('solids%E', e(k), k)
    end do
    do k = 1, 2
      call put_real('solids%nu', nu(k), k)
    end do
    do k = 1, 2
      call put_real('solids%R', r(k), k)
    end do
    do k = 1, 2
      call put_real('solids%resistivity', resistivity(k), k)
    end do
    call put_real('solids%friction', friction)
    call put_real('solids%hardness', hardness)
    call put_real('solids%size_effect', size_effect)
  end subroutine

  subroutine read_surface()
    character(len=32) :: source, normalise, detrend, missing
    character(len=4096) :: file
    character(len=1024) :: channel
    real(real64) :: l, hurst, l_lambda_l, l_lambda_s, sigma, filter_cutoff
    integer(int32) :: n
    logical :: plateau
    integer :: ios
    namelist /surface/ source, file, l, n, hurst, l_lambda_l, l_lambda_s, plateau, sigma, normalise, detrend, &
      missing, filter_cutoff, channel
    source = 'synthetic'
    file = ''
    l = unset
    n = 2048
    hurst = 0.8_real64
    l_lambda_l = 24
    l_lambda_s = 512
    plateau = .false.
    sigma = unset
    normalise = 'sample'
    detrend = 'plane'
    missing = 'refuse'
    filter_cutoff = 0
    channel = ''
    read (unit_in, nml=surface, iostat=ios)
    call status('surface', ios)
    call put_text('surface%source', source)
    call put_text('surface%file', file)
    call put_real('surface%L', l)
    call put_integer('surface%n', int(n, int64))
    call put_real('surface%hurst', hurst)
    call put_real('surface%L_lambda_l', l_lambda_l)
    call put_real('surface%L_lambda_s', l_lambda_s)
    call put_logical('surface%plateau', plateau)
    call put_real('surface%sigma', sigma)
    call put_text('surface%normalise', normalise)
    call put_text('surface%detrend', detrend)
    call put_text('surface%missing', missing)
    call put_real('surface%filter_cutoff', filter_cutoff)
    call put_text('surface%channel', channel)
  end subroutine

  subroutine read_asperities()
    character(len=32) :: curvature, law
    integer :: ios
    namelist /asperities/ curvature, law
    curvature = 'geometric'
    law = 'hertz'
    read (unit_in, nml=asperities, iostat=ios)
    call status('asperities', ios)
    call put_text('asperities%curvature', curvature)
    call put_text('asperities%law', law)
  end subroutine

  subroutine read_indentation()
    character(len=32) :: boundary, control, unit, spacing, selection
    real(real64) :: start, stop, centre(2), selection_factor
    real(real64), save :: levels(10000)
    integer(int32) :: steps
    integer :: ios, k
    namelist /indentation/ boundary, control, start, stop, steps, unit, spacing, levels, centre, selection, selection_factor
    boundary = 'free'
    control = 'separation'
    start = 4
    stop = 1
    steps = 100
    unit = 'sigma'
    spacing = 'linear'
    levels = unset
    centre = unset
    selection = 'overlap'
    selection_factor = 1.5_real64
    read (unit_in, nml=indentation, iostat=ios)
    call status('indentation', ios)
    call put_text('indentation%boundary', boundary)
    call put_text('indentation%control', control)
    call put_real('indentation%start', start)
    call put_real('indentation%stop', stop)
    call put_integer('indentation%steps', int(steps, int64))
    call put_text('indentation%unit', unit)
    call put_text('indentation%spacing', spacing)
    call put_list('indentation%levels', levels)
    do k = 1, 2
      call put_real('indentation%centre', centre(k), k)
    end do
    call put_text('indentation%selection', selection)
    call put_real('indentation%selection_factor', selection_factor)
  end subroutine

  subroutine read_solver()
    character(len=32) :: method, interaction, model
    real(real64) :: tolerance, delta0
    integer(int32) :: max_iterations
    integer :: ios
    namelist /solver/ method, tolerance, max_iterations, delta0, interaction, model
    method = 'auto'
    tolerance = 1.0e-6_real64
    max_iterations = 100
    delta0 = 0.01_real64
    interaction = 'point'
    model = 'asperities'
    read (unit_in, nml=solver, iostat=ios)
    call status('solver', ios)
    call put_text('solver%method', method)
    call put_real('solver%tolerance', tolerance)
    call put_integer('solver%max_iterations', int(max_iterations, int64))
    call put_real('solver%delta0', delta0)
    call put_text('solver%interaction', interaction)
    call put_text('solver%model', model)
  end subroutine

  subroutine read_elements()
    real(real64) :: points_per_wave
    integer :: ios
    namelist /elements/ points_per_wave
    points_per_wave = 8
    read (unit_in, nml=elements, iostat=ios)
    call status('elements', ios)
    call put_real('elements%points_per_wave', points_per_wave)
  end subroutine

  subroutine read_compare()
    real(real64) :: levels(1000)
    integer :: ios
    namelist /compare/ levels
    levels = unset
    read (unit_in, nml=compare, iostat=ios)
    call status('compare', ios)
    call put_list('compare%levels', levels)
  end subroutine

  subroutine read_output()
    character(len=4096) :: file
    character(len=32) :: format, contacts
    logical :: heights
    integer(int32) :: map_cells, radial_bins, pdf_bins, compression
    real(real64) :: pdf_levels(100)
    integer :: ios
    namelist /output/ file, format, contacts, heights, map_cells, radial_bins, pdf_levels, pdf_bins, compression
    file = 'output/rsc.nc'
    format = 'netcdf4'
    contacts = 'auto'
    heights = .false.
    map_cells = 50
    radial_bins = 50
    pdf_levels = unset
    pdf_bins = 60
    compression = 4
    read (unit_in, nml=output, iostat=ios)
    call status('output', ios)
    call put_text('output%file', file)
    call put_text('output%format', format)
    call put_text('output%contacts', contacts)
    call put_logical('output%heights', heights)
    call put_integer('output%map_cells', int(map_cells, int64))
    call put_integer('output%radial_bins', int(radial_bins, int64))
    call put_list('output%pdf_levels', pdf_levels)
    call put_integer('output%pdf_bins', int(pdf_bins, int64))
    call put_integer('output%compression', int(compression, int64))
  end subroutine

end program namelist_reader
