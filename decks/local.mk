nobase_dist_pkgdata_DATA += \
	decks/cylinder-2d2/README.md \
	decks/cylinder-2d2/cylinder-2d2.xml \
	decks/cylinder-2d2/schaefer_turek_bounds.csv \
	decks/exact-hydrostatic-3d/README.md \
	decks/exact-hydrostatic-3d/exact-hydrostatic-3d.xml \
	decks/exact-hydrostatic-3d/exact_hydrostatic_3d.csv \
	decks/exact-pressurewave-1d/README.md \
	decks/exact-pressurewave-1d/exact-pressurewave-1d.xml \
	decks/exact-pressurewave-1d/exact_pressurewave_1d.csv \
	decks/hydrostatic-plates/README.md \
	decks/hydrostatic-plates/hydrostatic-plates.xml \
	decks/hydrostatic-plates/hydrostatic_plates_analytic.csv \
	decks/isochoric-box/README.md \
	decks/isochoric-box/fixed-particles.png \
	decks/isochoric-box/isochoric-box.xml \
	decks/isochoric-box/sliding-particles.png \
	decks/taylor-couette/README.md \
	decks/taylor-couette/taylor-couette.xml \
	decks/taylor-couette/taylor_couette_analytic.csv \
	decks/taylor-couette/taylor_couette_transient.csv \
	decks/turek-hron-fsi2/README.md \
	decks/turek-hron-fsi2/turek-hron-fsi2.xml \
	decks/turek-hron-fsi2/turek-hron-fsi2.png \
	decks/turek-hron-fsi2/turek_hron_fsi2.csv \
	decks/validation.csv
