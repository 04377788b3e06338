% movements.pl - which movement it is, learned: movement(Mos, Hold, Qdc, Qtc, Grasp, Held, Carried, Stood, Eye, Movement).
% Learned from 15645 samples of 20 trials, at most 64 leaves, seed 1.
% A feature counts by its place in its order: casper.engine.movements.features.
% Leave-one-trial-out accuracy 0.8673 (by trial 0.8274 to 0.9339).
% Confusion counts (rows: true, columns: classified):
%                     pick      place      still  transport       walk
%   pick              4402        440         16         14         95
%   place              619       2795          4        111          9
%   still              158         32       1658          2        225
%   transport           19         45          0       1970         27
%   walk               137         16         82         25       2744
% 1 cm, 0.2 s: accuracy 0.9337, learned without it 0.9164.
% 1 cm, 0.5 s: accuracy 0.9561, learned without it 0.9439.
% 1 cm, 1 s: accuracy 0.8769, learned without it 0.8519.
% 10 cm, 0.2 s: accuracy 0.8135, learned without it 0.8127.
% 10 cm, 0.5 s: accuracy 0.7894, learned without it 0.7724.
% 10 cm, 1 s: accuracy 0.7061, learned without it 0.7134.
% 3 cm, 0.2 s: accuracy 0.9100, learned without it 0.9044.
% 3 cm, 0.5 s: accuracy 0.9180, learned without it 0.9041.
% 3 cm, 1 s: accuracy 0.8764, learned without it 0.8727.
% 6 cm, 0.2 s: accuracy 0.8568, learned without it 0.8633.
% 6 cm, 0.5 s: accuracy 0.8408, learned without it 0.8335.
% 6 cm, 1 s: accuracy 0.8106, learned without it 0.7951.

movement(still, _, touch, _, Grasp, brief, _, _, plain, pick) :- member(Grasp, [none, weak]).  % 154 samples
movement(still, _, touch, _, Grasp, short, _, _, plain, pick) :- member(Grasp, [none, weak]).  % 194 samples
movement(still, _, touch, _, Grasp, brief, _, _, filtered, place) :- member(Grasp, [none, weak]).  % 179 samples
movement(still, _, touch, _, Grasp, short, _, Stood, filtered, place) :- member(Grasp, [none, weak]), member(Stood, [brief, short, while]).  % 44 samples
movement(still, _, touch, _, Grasp, short, _, long, filtered, pick) :- member(Grasp, [none, weak]).  % 57 samples
movement(still, _, touch, _, Grasp, short, _, longer, filtered, place) :- member(Grasp, [none, weak]).  % 153 samples
movement(still, _, touch, _, none, while, _, _, plain, pick).  % 245 samples
movement(still, _, touch, _, none, while, _, _, filtered, pick).  % 365 samples
movement(still, _, touch, _, none, Held, _, Stood, _, pick) :- member(Held, [long, longer]), member(Stood, [brief, short, while, long]).  % 1165 samples
movement(still, _, touch, _, none, long, _, longer, _, pick).  % 594 samples
movement(still, _, touch, _, none, longer, _, longer, _, pick).  % 205 samples
movement(still, _, touch, _, weak, while, no, Stood, _, place) :- member(Stood, [brief, short, while]).  % 27 samples
movement(still, _, touch, _, weak, while, no, Stood, _, pick) :- member(Stood, [long, longer]).  % 119 samples
movement(still, _, touch, _, weak, long, no, _, _, pick).  % 205 samples
movement(still, _, touch, _, weak, longer, no, _, _, pick).  % 460 samples
movement(still, _, touch, _, weak, Held, yes, _, _, pick) :- member(Held, [while, long, longer]).  % 234 samples
movement(still, free, touch, _, Grasp, Held, _, _, _, place) :- member(Grasp, [strong, sure]), member(Held, [brief, short]).  % 251 samples
movement(still, holding, touch, _, Grasp, Held, _, Stood, _, pick) :- member(Grasp, [strong, sure]), member(Held, [brief, short]), member(Stood, [brief, short, while]).  % 31 samples
movement(still, holding, touch, _, Grasp, Held, _, long, _, pick) :- member(Grasp, [strong, sure]), member(Held, [brief, short]).  % 264 samples
movement(still, holding, touch, _, Grasp, brief, _, longer, plain, pick) :- member(Grasp, [strong, sure]).  % 111 samples
movement(still, holding, touch, _, Grasp, brief, _, longer, filtered, pick) :- member(Grasp, [strong, sure]).  % 216 samples
movement(still, holding, touch, _, Grasp, short, _, longer, _, place) :- member(Grasp, [strong, sure]).  % 395 samples
movement(still, free, touch, _, Grasp, Held, no, Stood, _, place) :- member(Grasp, [strong, sure]), member(Held, [while, long]), member(Stood, [brief, short, while]).  % 16 samples
movement(still, free, touch, _, Grasp, Held, no, Stood, _, pick) :- member(Grasp, [strong, sure]), member(Held, [while, long]), member(Stood, [long, longer]).  % 159 samples
movement(still, free, touch, _, Grasp, longer, no, _, _, place) :- member(Grasp, [strong, sure]).  % 241 samples
movement(still, free, touch, _, Grasp, Held, yes, _, _, pick) :- member(Grasp, [strong, sure]), member(Held, [while, long, longer]).  % 110 samples
movement(still, holding, touch, _, Grasp, Held, _, _, _, place) :- member(Grasp, [strong, sure]), member(Held, [while, long, longer]).  % 1908 samples
movement(still, _, Qdc, _, none, Held, _, Stood, _, still) :- member(Qdc, [near, medium, far, ignore]), member(Held, [brief, short, while, long]), member(Stood, [brief, short, while, long]).  % 1324 samples
movement(still, _, Qdc, _, none, Held, _, longer, _, pick) :- member(Qdc, [near, medium, far, ignore]), member(Held, [brief, short, while, long]).  % 7 samples
movement(still, _, Qdc, _, Grasp, Held, no, _, _, place) :- member(Qdc, [near, medium]), member(Grasp, [weak, strong, sure]), member(Held, [brief, short, while]).  % 59 samples
movement(still, _, Qdc, _, Grasp, long, no, Stood, _, still) :- member(Qdc, [near, medium]), member(Grasp, [weak, strong, sure]), member(Stood, [brief, short, while, long]).  % 21 samples
movement(still, _, Qdc, _, Grasp, long, no, longer, _, pick) :- member(Qdc, [near, medium]), member(Grasp, [weak, strong, sure]).  % 14 samples
movement(still, _, Qdc, _, Grasp, Held, no, _, _, still) :- member(Qdc, [far, ignore]), member(Grasp, [weak, strong, sure]), member(Held, [brief, short, while, long]).  % 16 samples
movement(still, _, Qdc, _, Grasp, Held, yes, _, _, still) :- member(Qdc, [near, medium, far, ignore]), member(Grasp, [weak, strong, sure]), member(Held, [brief, short, while, long]).  % 37 samples
movement(still, _, Qdc, _, none, longer, no, _, _, still) :- member(Qdc, [near, medium, far, ignore]).  % 51 samples
movement(still, _, Qdc, _, Grasp, longer, no, _, _, place) :- member(Qdc, [near, medium, far, ignore]), member(Grasp, [weak, strong, sure]).  % 53 samples
movement(still, _, Qdc, _, none, longer, yes, Stood, _, pick) :- member(Qdc, [near, medium, far, ignore]), member(Stood, [brief, short]).  % 104 samples
movement(still, _, Qdc, _, none, longer, yes, Stood, plain, still) :- member(Qdc, [near, medium, far, ignore]), member(Stood, [while, long, longer]).  % 22 samples
movement(still, _, near, _, none, longer, yes, Stood, filtered, pick) :- member(Stood, [while, long, longer]).  % 64 samples
movement(still, _, Qdc, _, none, longer, yes, Stood, filtered, still) :- member(Qdc, [medium, far, ignore]), member(Stood, [while, long, longer]).  % 23 samples
movement(still, _, Qdc, _, Grasp, longer, yes, _, _, pick) :- member(Qdc, [near, medium, far, ignore]), member(Grasp, [weak, strong, sure]).  % 150 samples
movement(moving, free, _, '-', _, Held, _, Stood, _, still) :- member(Held, [brief, short]), member(Stood, [brief, short]).  % 38 samples
movement(moving, free, _, '-', _, Held, _, Stood, _, walk) :- member(Held, [brief, short]), member(Stood, [while, long, longer]).  % 17 samples
movement(moving, free, touch, Qtc, _, Held, _, _, _, place) :- member(Qtc, ['0', '+']), member(Held, [brief, short]).  % 8 samples
movement(moving, free, Qdc, Qtc, _, Held, _, _, _, walk) :- member(Qdc, [near, medium, far, ignore]), member(Qtc, ['0', '+']), member(Held, [brief, short]).  % 176 samples
movement(moving, free, _, ignore, _, Held, _, _, _, still) :- member(Held, [brief, short]).  % 158 samples
movement(moving, free, touch, '-', _, Held, _, Stood, _, walk) :- member(Held, [while, long, longer]), member(Stood, [brief, short, while, long]).  % 98 samples
movement(moving, free, touch, Qtc, _, Held, _, Stood, _, pick) :- member(Qtc, ['0', '+', ignore]), member(Held, [while, long, longer]), member(Stood, [brief, short, while, long]).  % 42 samples
movement(moving, free, touch, _, _, Held, _, longer, _, pick) :- member(Held, [while, long, longer]).  % 95 samples
movement(moving, free, Qdc, '-', _, while, _, _, _, walk) :- member(Qdc, [near, medium, far, ignore]).  % 52 samples
movement(moving, free, Qdc, '0', _, while, _, _, _, still) :- member(Qdc, [near, medium, far, ignore]).  % 21 samples
movement(moving, free, near, Qtc, _, while, _, Stood, _, walk) :- member(Qtc, ['+', ignore]), member(Stood, [brief, short, while]).  % 287 samples
movement(moving, free, near, Qtc, _, while, _, Stood, _, still) :- member(Qtc, ['+', ignore]), member(Stood, [long, longer]).  % 5 samples
movement(moving, free, Qdc, Qtc, _, while, _, _, _, still) :- member(Qdc, [medium, far, ignore]), member(Qtc, ['+', ignore]).  % 38 samples
movement(moving, free, Qdc, _, Grasp, long, _, _, plain, walk) :- member(Qdc, [near, medium, far, ignore]), member(Grasp, [none, weak]).  % 326 samples
movement(moving, free, Qdc, _, Grasp, long, _, _, filtered, walk) :- member(Qdc, [near, medium, far, ignore]), member(Grasp, [none, weak]).  % 357 samples
movement(moving, free, Qdc, _, Grasp, longer, _, _, _, walk) :- member(Qdc, [near, medium, far, ignore]), member(Grasp, [none, weak]).  % 1688 samples
movement(moving, free, Qdc, _, Grasp, Held, _, _, _, walk) :- member(Qdc, [near, medium, far, ignore]), member(Grasp, [strong, sure]), member(Held, [long, longer]).  % 34 samples
movement(moving, holding, touch, _, _, brief, _, Stood, plain, walk) :- member(Stood, [brief, short, while, long]).  % 12 samples
movement(moving, holding, touch, _, _, brief, _, Stood, filtered, transport) :- member(Stood, [brief, short, while, long]).  % 28 samples
movement(moving, holding, touch, _, Grasp, Held, _, Stood, _, walk) :- member(Grasp, [none, weak, strong]), member(Held, [short, while, long, longer]), member(Stood, [brief, short, while, long]).  % 10 samples
movement(moving, holding, touch, _, sure, Held, _, Stood, _, transport) :- member(Held, [short, while, long, longer]), member(Stood, [brief, short, while, long]).  % 1746 samples
movement(moving, holding, touch, _, _, _, _, longer, _, transport).  % 338 samples
movement(moving, holding, Qdc, _, _, _, _, _, _, walk) :- member(Qdc, [near, medium, far, ignore]).  % 24 samples

% likelihood(Clause, Movement, P): of the clause's number, how likely its features are in each movement, as
% shares of the samples of each, half a count added.
likelihood(1, pick, 0.4068). likelihood(1, place, 0.2146). likelihood(1, still, 0.2758). likelihood(1, transport, 0.005666). likelihood(1, walk, 0.09719).
likelihood(2, pick, 0.7305). likelihood(2, place, 0.009351). likelihood(2, still, 0.1116). likelihood(2, transport, 0.00535). likelihood(2, walk, 0.1432).
likelihood(3, pick, 0.102). likelihood(3, place, 0.8336). likelihood(3, still, 0.04307). likelihood(3, transport, 0.004818). likelihood(3, walk, 0.01653).
likelihood(4, pick, 0.03823). likelihood(4, place, 0.9124). likelihood(4, still, 0.0183). likelihood(4, transport, 0.01842). likelihood(4, walk, 0.01264).
likelihood(5, pick, 0.442). likelihood(5, place, 0.3341). likelihood(5, still, 0.01628). likelihood(5, transport, 0.01639). likelihood(5, walk, 0.1911).
likelihood(6, pick, 0.1987). likelihood(6, place, 0.6399). likelihood(6, still, 0.1287). likelihood(6, transport, 0.005633). likelihood(6, walk, 0.02705).
likelihood(7, pick, 0.9842). likelihood(7, place, 0.002814). likelihood(7, still, 0.004798). likelihood(7, transport, 0.00483). likelihood(7, walk, 0.003314).
likelihood(8, pick, 0.5225). likelihood(8, place, 0.2393). likelihood(8, still, 0.1501). likelihood(8, transport, 0.00265). likelihood(8, walk, 0.08547).
likelihood(9, pick, 0.9857). likelihood(9, place, 0.01017). likelihood(9, still, 0.00102). likelihood(9, transport, 0.001027). likelihood(9, walk, 0.002114).
likelihood(10, pick, 0.9592). likelihood(10, place, 0.003462). likelihood(10, still, 0.0177). likelihood(10, transport, 0.001981). likelihood(10, walk, 0.01767).
likelihood(11, pick, 0.5715). likelihood(11, place, 0.2941). likelihood(11, still, 0.09249). likelihood(11, transport, 0.004901). likelihood(11, walk, 0.03699).
likelihood(12, pick, 0.08511). likelihood(12, place, 0.8364). likelihood(12, still, 0.0291). likelihood(12, transport, 0.0293). likelihood(12, walk, 0.0201).
likelihood(13, pick, 0.4029). likelihood(13, place, 0.4208). likelihood(13, still, 0.1312). likelihood(13, transport, 0.007767). likelihood(13, walk, 0.03731).
likelihood(14, pick, 0.8389). likelihood(14, place, 0.06631). likelihood(14, still, 0.04845). likelihood(14, transport, 0.00542). likelihood(14, walk, 0.0409).
likelihood(15, pick, 0.405). likelihood(15, place, 0.4952). likelihood(15, still, 0.06462). likelihood(15, transport, 0.002099). likelihood(15, walk, 0.03312).
likelihood(16, pick, 0.8867). likelihood(16, place, 0.1002). likelihood(16, still, 0.004879). likelihood(16, transport, 0.004912). likelihood(16, walk, 0.00337).
likelihood(17, pick, 0.1032). likelihood(17, place, 0.8709). likelihood(17, still, 0.01043). likelihood(17, transport, 0.003501). likelihood(17, walk, 0.01201).
likelihood(18, pick, 0.4238). likelihood(18, place, 0.3377). likelihood(18, still, 0.1919). likelihood(18, transport, 0.0276). likelihood(18, walk, 0.01894).
likelihood(19, pick, 0.8723). likelihood(19, place, 0.007333). likelihood(19, still, 0.004167). likelihood(19, transport, 0.1133). likelihood(19, walk, 0.002879).
likelihood(20, pick, 0.9302). likelihood(20, place, 0.04212). likelihood(20, still, 0.01026). likelihood(20, transport, 0.01033). likelihood(20, walk, 0.007087).
likelihood(21, pick, 0.4981). likelihood(21, place, 0.4707). likelihood(21, still, 0.004639). likelihood(21, transport, 0.02335). likelihood(21, walk, 0.003204).
likelihood(22, pick, 0.2032). likelihood(22, place, 0.6623). likelihood(22, still, 0.002201). likelihood(22, transport, 0.1307). likelihood(22, walk, 0.00152).
likelihood(23, pick, 0.01859). likelihood(23, place, 0.8614). likelihood(23, still, 0.0445). likelihood(23, transport, 0.0448). likelihood(23, walk, 0.03074).
likelihood(24, pick, 0.7771). likelihood(24, place, 0.1812). likelihood(24, still, 0.02059). likelihood(24, transport, 0.00691). likelihood(24, walk, 0.01422).
likelihood(25, pick, 0.3597). likelihood(25, place, 0.6027). likelihood(25, still, 0.01984). likelihood(25, transport, 0.003995). likelihood(25, walk, 0.0137).
likelihood(26, pick, 0.8189). likelihood(26, place, 0.1342). likelihood(26, still, 0.009949). likelihood(26, transport, 0.03005). likelihood(26, walk, 0.006873).
likelihood(27, pick, 0.02865). likelihood(27, place, 0.9536). likelihood(27, still, 0.003138). likelihood(27, transport, 0.01309). likelihood(27, walk, 0.001548).
likelihood(28, pick, 0.0007947). likelihood(28, place, 0.0006694). likelihood(28, still, 0.9811). likelihood(28, transport, 0.000383). likelihood(28, walk, 0.01708).
likelihood(29, pick, 0.5493). likelihood(29, place, 0.1779). likelihood(29, still, 0.1011). likelihood(29, transport, 0.1018). likelihood(29, walk, 0.06986).
likelihood(30, pick, 0.1314). likelihood(30, place, 0.6657). likelihood(30, still, 0.1231). likelihood(30, transport, 0.01377). likelihood(30, walk, 0.06612).
likelihood(31, pick, 0.1271). likelihood(31, place, 0.1135). likelihood(31, still, 0.636). likelihood(31, transport, 0.02784). likelihood(31, walk, 0.09551).
likelihood(32, pick, 0.6498). likelihood(32, place, 0.1824). likelihood(32, still, 0.06221). likelihood(32, transport, 0.06263). likelihood(32, walk, 0.04297).
likelihood(33, pick, 0.0117). likelihood(33, place, 0.01643). likelihood(33, still, 0.9243). likelihood(33, transport, 0.0282). likelihood(33, walk, 0.01935).
likelihood(34, pick, 0.01665). likelihood(34, place, 0.007789). likelihood(34, still, 0.9163). likelihood(34, transport, 0.01337). likelihood(34, walk, 0.04587).
likelihood(35, pick, 0.003953). likelihood(35, place, 0.005549). likelihood(35, still, 0.9744). likelihood(35, transport, 0.009525). likelihood(35, walk, 0.006535).
likelihood(36, pick, 0.2984). likelihood(36, place, 0.4562). likelihood(36, still, 0.1746). likelihood(36, transport, 0.01598). likelihood(36, walk, 0.05482).
likelihood(37, pick, 0.6861). likelihood(37, place, 0.01632). likelihood(37, still, 0.269). likelihood(37, transport, 0.00934). likelihood(37, walk, 0.01923).
likelihood(38, pick, 0.008759). likelihood(38, place, 0.0123). likelihood(38, still, 0.9434). likelihood(38, transport, 0.02111). likelihood(38, walk, 0.01448).
likelihood(39, pick, 0.4421). likelihood(39, place, 0.007302). likelihood(39, still, 0.4606). likelihood(39, transport, 0.01253). likelihood(39, walk, 0.0774).
likelihood(40, pick, 0.08348). likelihood(40, place, 0.01302). likelihood(40, still, 0.8658). likelihood(40, transport, 0.02235). likelihood(40, walk, 0.01534).
likelihood(41, pick, 0.8134). likelihood(41, place, 0.03765). likelihood(41, still, 0.06418). likelihood(41, transport, 0.05026). likelihood(41, walk, 0.03448).
likelihood(42, pick, 0.005325). likelihood(42, place, 0.007475). likelihood(42, still, 0.9303). likelihood(42, transport, 0.01283). likelihood(42, walk, 0.04402).
likelihood(43, pick, 0.04492). likelihood(43, place, 0.02102). likelihood(43, still, 0.03583). likelihood(43, transport, 0.1804). likelihood(43, walk, 0.7179).
likelihood(44, pick, 0.08215). likelihood(44, place, 0.346). likelihood(44, still, 0.1966). likelihood(44, transport, 0.3299). likelihood(44, walk, 0.04528).
likelihood(45, pick, 0.001515). likelihood(45, place, 0.006382). likelihood(45, still, 0.3373). likelihood(45, transport, 0.01095). likelihood(45, walk, 0.6439).
likelihood(46, pick, 0.00132). likelihood(46, place, 0.001853). likelihood(46, still, 0.9696). likelihood(46, transport, 0.00318). likelihood(46, walk, 0.024).
likelihood(47, pick, 0.146). likelihood(47, place, 0.01367). likelihood(47, still, 0.03884). likelihood(47, transport, 0.02346). likelihood(47, walk, 0.778).
likelihood(48, pick, 0.329). likelihood(48, place, 0.07886). likelihood(48, still, 0.05762). likelihood(48, transport, 0.09668). likelihood(48, walk, 0.4378).
likelihood(49, pick, 0.4532). likelihood(49, place, 0.01689). likelihood(49, still, 0.0096). likelihood(49, transport, 0.009665). likelihood(49, walk, 0.5106).
likelihood(50, pick, 0.004623). likelihood(50, place, 0.006489). likelihood(50, still, 0.5421). likelihood(50, transport, 0.01114). likelihood(50, walk, 0.4356).
likelihood(51, pick, 0.02854). likelihood(51, place, 0.01336). likelihood(51, still, 0.888). likelihood(51, transport, 0.02292). likelihood(51, walk, 0.04719).
likelihood(52, pick, 0.0009909). likelihood(52, place, 0.004173). likelihood(52, still, 0.1684). likelihood(52, transport, 0.002388). likelihood(52, walk, 0.8241).
likelihood(53, pick, 0.03049). likelihood(53, place, 0.04281). likelihood(53, still, 0.8028). likelihood(53, transport, 0.07348). likelihood(53, walk, 0.05042).
likelihood(54, pick, 0.005985). likelihood(54, place, 0.008402). likelihood(54, still, 0.6446). likelihood(54, transport, 0.01442). likelihood(54, walk, 0.3266).
likelihood(55, pick, 0.0008957). likelihood(55, place, 0.001257). likelihood(55, still, 0.08789). likelihood(55, transport, 0.002158). likelihood(55, walk, 0.9078).
likelihood(56, pick, 0.003897). likelihood(56, place, 0.001094). likelihood(56, still, 0.2444). likelihood(56, transport, 0.001878). likelihood(56, walk, 0.7487).
likelihood(57, pick, 0.01452). likelihood(57, place, 0.001762). likelihood(57, still, 0.02189). likelihood(57, transport, 0.00216). likelihood(57, walk, 0.9597).
likelihood(58, pick, 0.0511). likelihood(58, place, 0.01025). likelihood(58, still, 0.05241). likelihood(58, transport, 0.4397). likelihood(58, walk, 0.4465).
likelihood(59, pick, 0.01885). likelihood(59, place, 0.02646). likelihood(59, still, 0.1354). likelihood(59, transport, 0.2271). likelihood(59, walk, 0.5922).
likelihood(60, pick, 0.08481). likelihood(60, place, 0.01082). likelihood(60, still, 0.01845). likelihood(60, transport, 0.8732). likelihood(60, walk, 0.01275).
likelihood(61, pick, 0.0213). likelihood(61, place, 0.1495). likelihood(61, still, 0.1529). likelihood(61, transport, 0.3593). likelihood(61, walk, 0.317).
likelihood(62, pick, 0.002298). likelihood(62, place, 0.01851). likelihood(62, still, 0.001448). likelihood(62, transport, 0.9715). likelihood(62, walk, 0.0062).
likelihood(63, pick, 0.0006572). likelihood(63, place, 0.1061). likelihood(63, still, 0.001573). likelihood(63, transport, 0.8884). likelihood(63, walk, 0.00326).
likelihood(64, pick, 0.0105). likelihood(64, place, 0.04423). likelihood(64, still, 0.1257). likelihood(64, transport, 0.1771). likelihood(64, walk, 0.6424).

% emission(True, Seen, P): the cross-validated confusion, half a count added to each, as shares.
emission(pick, pick, 0.8859).
emission(pick, place, 0.0886).
emission(pick, still, 0.0033).
emission(pick, transport, 0.0029).
emission(pick, walk, 0.0192).
emission(place, pick, 0.1750).
emission(place, place, 0.7896).
emission(place, still, 0.0013).
emission(place, transport, 0.0315).
emission(place, walk, 0.0027).
emission(still, pick, 0.0763).
emission(still, place, 0.0156).
emission(still, still, 0.7983).
emission(still, transport, 0.0012).
emission(still, walk, 0.1085).
emission(transport, pick, 0.0094).
emission(transport, place, 0.0220).
emission(transport, still, 0.0002).
emission(transport, transport, 0.9549).
emission(transport, walk, 0.0133).
emission(walk, pick, 0.0457).
emission(walk, place, 0.0055).
emission(walk, still, 0.0274).
emission(walk, transport, 0.0085).
emission(walk, walk, 0.9129).

% lasts(Movement, Seconds, Phases): mean time, and how regular it is.
lasts(pick, 3.8, 3).
lasts(place, 2.7, 3).
lasts(still, 0.5, 3).
lasts(transport, 4.0, 3).
lasts(walk, 2.9, 3).
