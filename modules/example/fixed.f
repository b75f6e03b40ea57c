C     A sphere pressed on a rough surface and drawn over it, in FORTRAN 77:
C     integer handles, names of six letters, every error checked.
C     Checks: the sum of the spots is the force, one asperity agrees with
C     Hertz, errors are reported and change nothing.
      PROGRAM FIXED
      INTEGER MAXSPT
      PARAMETER (MAXSPT = 5000)
      INTEGER ICASE, IASP, ICON, IERR, K, N, ISTAT, NCAND, NIT, NOVER
      INTEGER LIST(MAXSPT), IFRI, ICOPY
      DOUBLE PRECISION F(MAXSPT), A(MAXSPT), U(MAXSPT)
      DOUBLE PRECISION Z0, FORCE, AREA, STIFF, RES, TOTAL, ONE(1), W(1)
      CHARACTER*200 TEXT
      INTEGER ITWO(2), IOLD
      DOUBLE PRECISION DTWO(2)
      DATA ITWO /1, 2/, DTWO /1.0D0, 2.0D0/
C     Checks the sizes of INTEGER (8 bytes with -fdefault-integer-8) and
C     DOUBLE PRECISION (16 with -fdefault-real-8) before any other call.
      IERR = 0
      CALL RSCCAS(ICASE, IERR)
      IF (IERR .NE. 4) CALL WRONG('a call before RSCINT')
      CALL RSCINT(ITWO, IERR)
      CALL CHECK('RSCINT', IERR)
      CALL RSCDBL(DTWO, IERR)
      CALL CHECK('RSCDBL', IERR)
C     Units: mm and N.
      ICASE = 0
      CALL RSCCAS(ICASE, IERR)
      CALL CHECK('RSCCAS', IERR)
      CALL RSCRED(ICASE, '&surface n=256, L_lambda_l=8, L_lambda_s=64, '
     1   //'sigma=0.01 / &solver model=''asperities'' /', IERR)
      CALL CHECK('RSCRED', IERR)
      CALL RSCSET(ICASE, 'solver%tolerance', '1.0e-10', IERR)
      CALL CHECK('RSCSET', IERR)
      CALL RSCGET(ICASE, 'surface%n', TEXT, IERR)
      IF (IERR .NE. 0 .OR. TEXT .NE. '256') CALL WRONG('RSCGET')
      CALL RSCMAK(IASP, ICASE, 1, IERR)
      CALL CHECK('RSCMAK', IERR)
      CALL RSCCNC(ICON, IASP, ICASE, IERR)
      CALL CHECK('RSCCNC', IERR)
C     Neither a trial step that is rolled back nor a modified copy changes
C     the contact.
      CALL RSCIND(ICON, 0.0D0, RES, IERR)
      CALL CHECK('RSCIND', IERR)
      CALL RSCCOM(ICON, IERR)
      CALL CHECK('RSCCOM', IERR)
      CALL RSCSAV(ICON, 'fixed.kept', IERR)
      CALL CHECK('RSCSAV', IERR)
      CALL RSCCPY(ICOPY, ICON, IERR)
      CALL CHECK('RSCCPY', IERR)
      CALL RSCTIP(ICOPY, 0.4D0, 0.4D0, IERR)
      CALL RSCIND(ICOPY, -1.0D-3, FORCE, IERR)
      CALL CHECK('RSCIND', IERR)
      CALL RSCRES(ICON, Z0, FORCE, AREA, N, IERR)
      IF (IERR .NE. 0 .OR. FORCE .NE. RES) CALL WRONG('copy')
      CALL RSCROL(ICOPY, IERR)
      CALL RSCRES(ICOPY, Z0, FORCE, AREA, N, IERR)
      IF (IERR .NE. 0 .OR. FORCE .NE. RES) CALL WRONG('rolled back')
      IOLD = ICOPY
      CALL RSCDEL(ICOPY, IERR)
      CALL CHECK('RSCDEL', IERR)
      CALL RSCRST(ICOPY, IASP, 'fixed.kept', IERR)
      CALL CHECK('RSCRST', IERR)
      OPEN (10, FILE = 'fixed.kept')
      CLOSE (10, STATUS = 'DELETE')
      CALL RSCRES(ICOPY, Z0, FORCE, AREA, N, IERR)
      IF (IERR .NE. 0 .OR. FORCE .NE. RES) CALL WRONG('restored')
      CALL RSCRES(IOLD, Z0, FORCE, AREA, N, IERR)
      IF (IERR .NE. -1) CALL WRONG('deleted, and its place used again')
      CALL RSCDEL(ICOPY, IERR)
      CALL RSCDEL(IASP, IERR)
      CALL CHECK('RSCDEL', IERR)
      IF (IASP .NE. 0) CALL WRONG('a deleted handle is not 0')
      WRITE (*, '(A)') '   x0 [mm]     Z0 [mm]      A [mm2]   contacts'
      DO 20 K = 1, 5
         CALL RSCTIP(ICON, 0.4D0 + 0.04D0 * K, 0.5D0, IERR)
         CALL CHECK('RSCTIP', IERR)
         CALL RSCPRS(ICON, 20.0D0, Z0, IERR)
         CALL CHECK('RSCPRS', IERR)
         CALL RSCRES(ICON, Z0, FORCE, AREA, N, IERR)
         CALL CHECK('RSCRES', IERR)
         WRITE (*, '(F10.3, 2ES13.4, I8)') 0.4D0 + 0.04D0 * K, Z0, AREA,
     1      N
         CALL RSCSPT(ICON, MAXSPT, LIST, F, A, U, IERR)
         CALL CHECK('RSCSPT', IERR)
         TOTAL = 0
         DO 10 NIT = 1, N
   10    TOTAL = TOTAL + F(NIT)
         IF (ABS(TOTAL - FORCE) .GT. 1D-12 * FORCE) CALL WRONG('sum')
   20 CONTINUE
      CALL RSCSTF(ICON, STIFF, IERR)
      CALL CHECK('RSCSTF', IERR)
      IF (STIFF .GE. 0) CALL WRONG('stiffness')
      CALL RSCLEV(ICON, ISTAT, NCAND, NIT, NOVER, RES, IERR)
      CALL CHECK('RSCLEV', IERR)
      IF (NCAND .LT. N .OR. RES .GT. 1D-10) CALL WRONG('RSCLEV')
C     Errors are reported, and nothing changes.
      FORCE = -7
      CALL RSCPRS(ICON, -1.0D0, FORCE, IERR)
      IF (IERR .NE. -2 .OR. FORCE .NE. -7) CALL WRONG('no error')
      CALL RSCMSG(TEXT)
      IF (INDEX(TEXT, 'force') .EQ. 0) CALL WRONG('RSCMSG')
      CALL RSCIND(ICASE, 0.0D0, FORCE, IERR)
      IF (IERR .NE. -1) CALL WRONG('a case is no contact')
      CALL RSCMSG(TEXT)
      IF (INDEX(TEXT, 'handle') .EQ. 0) CALL WRONG('RSCMSG of a handle')
C     One asperity, against Hertz.
      ONE(1) = 0
      W(1) = 0.3D0
      CALL RSCASP(IASP, 1, ONE, ONE, ONE, W, IERR)
      CALL CHECK('RSCASP', IERR)
      CALL RSCDEL(ICON, IERR)
      CALL RSCCON(ICON, IASP, 2.0D5, 5.0D0, 0.0D0, 0.0D0, 0, IERR)
      CALL CHECK('RSCCON', IERR)
      CALL RSCIND(ICON, -1.0D-3, FORCE, IERR)
      CALL CHECK('RSCIND', IERR)
      TOTAL = 4.0D0 / 3.0D0 * 2.0D5 * SQRT(0.3D0) * 1.0D-3**1.5D0
      IF (ABS(FORCE - TOTAL) .GT. 1D-12 * TOTAL) CALL WRONG('Hertz')
      CALL RSCSPT(ICON, 1, LIST, F, A, U, IERR)
      IF (IERR .NE. 0 .OR. LIST(1) .NE. 1) CALL WRONG('index from 1')
      CALL RSCDFL(ICON, 1, ONE, ONE, W, IERR)
      IF (IERR .NE. 0 .OR. ABS(W(1) - 1.0D-3) .GT. 1D-12)
     1   CALL WRONG('deflection')
C     In full slip the tangential force is mu N, and a trial step that is
C     rolled back changes nothing.
      CALL RSCSET(ICASE, 'solids%friction', '0.25', IERR)
      CALL CHECK('RSCSET', IERR)
      CALL RSCFRI(IFRI, ICON, ICASE, IERR)
      CALL CHECK('RSCFRI', IERR)
      CALL RSCUPD(IFRI, -1.0D-3, 0.0D0, 0.0D0, FORCE, U(1), U(2), RES,
     1   IERR)
      CALL CHECK('RSCUPD', IERR)
      CALL RSCCMT(IFRI, IERR)
      CALL RSCUPD(IFRI, -1.0D-3, 1.0D0, 0.0D0, FORCE, U(1), U(2), RES,
     1   IERR)
      CALL CHECK('RSCUPD', IERR)
      IF (ABS(U(1) - 0.25D0 * FORCE) .GT. 1D-9 * FORCE) CALL WRONG('mu')
      CALL RSCRBK(IFRI, IERR)
      CALL CHECK('RSCRBK', IERR)
      CALL RSCUPD(IFRI, -1.0D-3, 0.0D0, 0.0D0, FORCE, U(1), U(2), RES,
     1   IERR)
      IF (IERR .NE. 0 .OR. ABS(U(1)) .GT. 0) CALL WRONG('rollback')
      CALL RSCDEL(IFRI, IERR)
      CALL RSCDEL(ICON, IERR)
      CALL RSCDEL(IASP, IERR)
      CALL RSCDEL(ICASE, IERR)
      CALL CHECK('RSCDEL', IERR)
      CALL RSCDEL(7, IERR)
      IF (IERR .NE. -1) CALL WRONG('7 is no handle')
      END

      SUBROUTINE CHECK(WHAT, IERR)
      CHARACTER*(*) WHAT
      INTEGER IERR
      CHARACTER*200 TEXT
      IF (IERR .EQ. 0) RETURN
      CALL RSCMSG(TEXT)
      WRITE (*, *) WHAT, ': ', TEXT
      STOP 1
      END

      SUBROUTINE WRONG(WHAT)
      CHARACTER*(*) WHAT
      WRITE (*, *) 'wrong: ', WHAT
      STOP 2
      END
